// What a robot knows about the walls.
#ifndef WASMOUSE_MAP_H
#define WASMOUSE_MAP_H

#include "wasmouse/robot.h"

// The walls of a square maze, each unknown, open or closed. At first the perimeter is closed and
// everything else is unknown. One bit for each heading: 1 << heading.
typedef struct {
  uint32_t dimension;
  uint8_t open[DIMENSION_MAX][DIMENSION_MAX];   // by x and y
  uint8_t closed[DIMENSION_MAX][DIMENSION_MAX]; // by x and y
} Map;

// How to treat unknown walls.
typedef enum {
  VIEW_OPTIMISTIC,  // they count as open: for exploring
  VIEW_PESSIMISTIC, // they count as closed: for driving only where it is certain
} View;

void map_init(Map *map, uint32_t dimension);
bool map_contains(const Map *map, Cell cell);

Wall map_wall(const Map *map, Cell cell, Heading heading);

// Sets a wall on both of its sides. Returns whether that was news.
bool map_set(Map *map, Cell cell, Heading heading, Wall wall);

// Adds the readings made at a pose. Returns how many walls were not known to be closed before.
uint32_t map_observe(Map *map, Pose pose, Sensors sensors);

// Whether the robot may drive through that side of a cell.
static inline bool map_is_open(const Map *map, View view, Cell cell, Heading heading) {
  uint8_t open = view == VIEW_OPTIMISTIC ? (uint8_t)~map->closed[cell.x][cell.y]
                                         : map->open[cell.x][cell.y];
  return open >> heading & 1;
}

// How many cells the robot may drive in that direction, up to a limit.
uint32_t map_clear_cells(const Map *map, View view, Cell cell, Heading heading, uint32_t limit);

#endif
