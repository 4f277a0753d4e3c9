#include "wasmouse/map.h"

void map_init(Map *map, uint32_t dimension) {
  robot_assert(dimension >= 2 && dimension <= DIMENSION_MAX);
  *map = (Map){.dimension = dimension};
  for (uint32_t i = 0; i < dimension; i++) {
    map->closed[i][dimension - 1] |= 1 << HEADING_UP;
    map->closed[dimension - 1][i] |= 1 << HEADING_RIGHT;
    map->closed[i][0] |= 1 << HEADING_DOWN;
    map->closed[0][i] |= 1 << HEADING_LEFT;
  }
}

bool map_contains(const Map *map, Cell cell) {
  return cell.x < map->dimension && cell.y < map->dimension;
}

Wall map_wall(const Map *map, Cell cell, Heading heading) {
  if (map->closed[cell.x][cell.y] >> heading & 1) return WALL_CLOSED;
  return map->open[cell.x][cell.y] >> heading & 1 ? WALL_OPEN : WALL_UNKNOWN;
}

static void set_side(Map *map, Cell cell, Heading heading, Wall wall) {
  uint8_t bit = (uint8_t)(1 << heading);
  uint8_t *open = &map->open[cell.x][cell.y], *closed = &map->closed[cell.x][cell.y];
  *open = wall == WALL_OPEN ? *open | bit : *open & ~bit;
  *closed = wall == WALL_CLOSED ? *closed | bit : *closed & ~bit;
}

bool map_set(Map *map, Cell cell, Heading heading, Wall wall) {
  if (map_wall(map, cell, heading) == wall) return false;
  Cell neighbor = cell_toward(cell, heading, 1);
  if (!map_contains(map, neighbor)) return false; // the perimeter stays closed
  set_side(map, cell, heading, wall);
  set_side(map, neighbor, heading_opposite(heading), wall);
  return true;
}

static uint32_t look(Map *map, Cell cell, Heading heading, uint32_t reading) {
  for (; reading > 0; reading--) {
    map_set(map, cell, heading, WALL_OPEN);
    cell = cell_toward(cell, heading, 1);
    robot_assert(map_contains(map, cell));
  }
  return map_set(map, cell, heading, WALL_CLOSED);
}

uint32_t map_observe(Map *map, Pose pose, Sensors sensors) {
  return look(map, pose.cell, heading_turned(pose.heading, TURN_LEFT), sensors.left) +
         look(map, pose.cell, pose.heading, sensors.front) +
         look(map, pose.cell, heading_turned(pose.heading, TURN_RIGHT), sensors.right);
}

uint32_t map_clear_cells(const Map *map, View view, Cell cell, Heading heading, uint32_t limit) {
  uint32_t cells = 0;
  while (cells < limit && map_is_open(map, view, cell, heading)) {
    cell = cell_toward(cell, heading, 1);
    cells++;
  }
  return cells;
}
