#include "wasmouse/map.hpp"

namespace wasmouse {

Map::Map(uint32_t dimension) : dimension(dimension) {
  robot_assert(dimension >= 2 && dimension <= dimension_max);
  for (uint32_t i = 0; i < dimension; i++) {
    set_side({i, dimension - 1}, Heading::up, Wall::closed);
    set_side({dimension - 1, i}, Heading::right, Wall::closed);
    set_side({i, 0}, Heading::down, Wall::closed);
    set_side({0, i}, Heading::left, Wall::closed);
  }
}

Wall Map::wall(Cell cell, Heading heading) const {
  const Sides &sides = walls[cell.x][cell.y];
  if (sides.closed & bit(heading)) return Wall::closed;
  return sides.open & bit(heading) ? Wall::open : Wall::unknown;
}

void Map::set_side(Cell cell, Heading heading, Wall wall) {
  Sides &sides = walls[cell.x][cell.y];
  sides.open &= ~bit(heading);
  sides.closed &= ~bit(heading);
  if (wall == Wall::open) sides.open |= bit(heading);
  if (wall == Wall::closed) sides.closed |= bit(heading);
}

bool Map::set(Cell cell, Heading heading, Wall wall) {
  Cell neighbor = cell.toward(heading, 1);
  if (this->wall(cell, heading) == wall || !contains(neighbor)) return false;
  set_side(cell, heading, wall);
  set_side(neighbor, opposite(heading), wall);
  return true;
}

uint32_t Map::look(Cell cell, Heading heading, uint32_t reading) {
  for (; reading > 0; reading--) {
    set(cell, heading, Wall::open);
    cell = cell.toward(heading, 1);
    robot_assert(contains(cell));
  }
  return set(cell, heading, Wall::closed);
}

uint32_t Map::observe(Pose pose, Sensors sensors) {
  return look(pose.cell, turned(pose.heading, Turn::left), sensors.left) +
         look(pose.cell, pose.heading, sensors.front) +
         look(pose.cell, turned(pose.heading, Turn::right), sensors.right);
}

uint32_t Map::clear_cells(View view, Cell cell, Heading heading, uint32_t limit) const {
  uint32_t cells = 0;
  for (; cells < limit && is_open(view, cell, heading); cells++) cell = cell.toward(heading, 1);
  return cells;
}

} // namespace wasmouse
