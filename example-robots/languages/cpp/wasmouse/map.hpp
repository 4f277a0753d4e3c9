// What a robot knows about the walls.
#pragma once

#include "wasmouse/robot.hpp"

namespace wasmouse {

// How to treat unknown walls.
enum class View {
  optimistic,  // they count as open: for exploring
  pessimistic, // they count as closed: for driving only where it is certain
};

// The walls of a square maze, each unknown, open or closed. At first the perimeter is closed and
// everything else is unknown.
class Map {
public:
  explicit Map(uint32_t dimension = 2);

  bool contains(Cell cell) const {
    return cell.x < dimension && cell.y < dimension;
  }

  Wall wall(Cell cell, Heading heading) const;

  // Sets a wall on both of its sides, except that the perimeter stays closed. Returns whether that
  // was news.
  bool set(Cell cell, Heading heading, Wall wall);

  // Adds the readings made at a pose. Returns how many walls were not known to be closed before.
  uint32_t observe(Pose pose, Sensors sensors);

  // Whether the robot may drive through that side of a cell.
  bool is_open(View view, Cell cell, Heading heading) const {
    const Sides &sides = walls[cell.x][cell.y];
    uint8_t open = view == View::optimistic ? uint8_t(~sides.closed) : sides.open;
    return open & bit(heading);
  }

  // How many cells the robot may drive in that direction, up to a limit.
  uint32_t clear_cells(View view, Cell cell, Heading heading, uint32_t limit) const;

private:
  // One bit for each heading.
  struct Sides {
    uint8_t open = 0, closed = 0;
  };

  static constexpr uint8_t bit(Heading heading) {
    return uint8_t(1 << uint8_t(heading));
  }

  uint32_t look(Cell cell, Heading heading, uint32_t reading);
  void set_side(Cell cell, Heading heading, Wall wall);

  uint32_t dimension;
  Sides walls[dimension_max][dimension_max]; // by x and y
};

} // namespace wasmouse
