// Directions, cells and poses. x grows to the right, y grows upward; (0, 0) is the bottom left cell.
#pragma once

#include <stdint.h>

namespace wasmouse {

// The largest maze, in cells along each side.
inline constexpr uint32_t dimension_max = 64;

// A rotation on the spot.
enum class Turn : uint8_t { left, straight, right };

inline constexpr Turn all_turns[] = {Turn::left, Turn::straight, Turn::right};

// A direction in the maze, clockwise. The robot starts both runs heading up.
enum class Heading : uint8_t { up, right, down, left };

inline constexpr Heading all_headings[] = {Heading::up, Heading::right, Heading::down,
                                           Heading::left};

constexpr Heading turned(Heading heading, Turn turn) {
  return Heading((uint8_t(heading) + uint8_t(turn) + 3) % 4);
}

constexpr Heading opposite(Heading heading) {
  return Heading((uint8_t(heading) + 2) % 4);
}

struct Cell {
  uint32_t x = 0, y = 0;

  constexpr bool operator==(const Cell &other) const {
    return x == other.x && y == other.y;
  }

  // The cell that many cells away. The caller knows that it is in the maze.
  constexpr Cell toward(Heading heading, uint32_t cells) const {
    switch (heading) {
    case Heading::up: return {x, y + cells};
    case Heading::right: return {x + cells, y};
    case Heading::down: return {x, y - cells};
    default: return {x - cells, y};
    }
  }
};

// A rectangle of cells; `origin` is the bottom left one.
struct Area {
  Cell origin;
  uint32_t width = 0, height = 0;

  constexpr bool contains(Cell cell) const {
    // Unsigned: a cell before the origin is very far behind it.
    return cell.x - origin.x < width && cell.y - origin.y < height;
  }
};

// Where the robot is and where it looks.
struct Pose {
  Cell cell;
  Heading heading = Heading::up;

  constexpr bool operator==(const Pose &other) const {
    return cell == other.cell && heading == other.heading;
  }
};

} // namespace wasmouse
