// Directions, cells and poses. x grows to the right, y grows upward; (0, 0) is the bottom left cell.
#ifndef WASMOUSE_GEOMETRY_H
#define WASMOUSE_GEOMETRY_H

#include <stdbool.h>
#include <stdint.h>

// The largest maze, in cells along each side.
enum { DIMENSION_MAX = 64 };

// A direction in the maze, clockwise. The robot starts both runs heading up.
typedef enum { HEADING_UP, HEADING_RIGHT, HEADING_DOWN, HEADING_LEFT } Heading;
enum { HEADINGS = 4 };

// A rotation on the spot.
typedef enum { TURN_LEFT, TURN_STRAIGHT, TURN_RIGHT } Turn;

typedef struct {
  uint32_t x, y;
} Cell;

// A rectangle of cells.
typedef struct {
  Cell origin; // the bottom left cell
  uint32_t width, height;
} Area;

// Where the robot is and where it looks.
typedef struct {
  Cell cell;
  Heading heading;
} Pose;

static inline Heading heading_turned(Heading heading, Turn turn) {
  return (Heading)((heading + turn + 3) % HEADINGS);
}

static inline Heading heading_opposite(Heading heading) {
  return (Heading)((heading + 2) % HEADINGS);
}

static inline bool cell_equal(Cell a, Cell b) {
  return a.x == b.x && a.y == b.y;
}

// The cell that many cells away. The caller knows that it is in the maze.
static inline Cell cell_toward(Cell cell, Heading heading, uint32_t cells) {
  switch (heading) {
  case HEADING_UP: return (Cell){cell.x, cell.y + cells};
  case HEADING_RIGHT: return (Cell){cell.x + cells, cell.y};
  case HEADING_DOWN: return (Cell){cell.x, cell.y - cells};
  default: return (Cell){cell.x - cells, cell.y};
  }
}

static inline bool area_contains(Area area, Cell cell) {
  // Unsigned: a cell before the origin is very far behind it.
  return cell.x - area.origin.x < area.width && cell.y - area.origin.y < area.height;
}

#endif
