// The fewest steps from every cell to a goal. One step drives up to the longest move in a straight
// line, in any direction, so the heading does not matter.
#ifndef WASMOUSE_SEARCH_H
#define WASMOUSE_SEARCH_H

#include "wasmouse/map.h"

// What `search_steps` returns for cells that the last search did not reach.
enum { NOT_REACHED = 0xFFFF };

// The distances of the last search.
typedef struct {
  uint32_t longest_move;
  uint16_t steps[DIMENSION_MAX][DIMENSION_MAX]; // by x and y
} Search;

// A drive in a direction of the maze.
typedef struct {
  Heading heading;
  uint32_t cells; // 0 where there is none
} Hop;

// Nothing is reached yet.
void search_init(Search *search, uint32_t longest_move);

// Computes the distance of every cell to the goal, until that of `from` is known: all cells at most
// as far as `from` are known then, and the others count as not reached.
void search_fill_until(Search *search, const Map *map, View view, Area goal, Cell from);

static inline uint16_t search_steps(const Search *search, Cell cell) {
  return search->steps[cell.x][cell.y];
}

// The next hop of a shortest route. Between routes of equal length it prefers to drive straight,
// then right, left, backwards; then longer hops to shorter ones. Its `cells` are 0 if the last
// search knows no route.
Hop search_next_hop(const Search *search, const Map *map, View view, Pose pose);

// The same, provided that the whole route still leads to the goal. Walls that close make no route
// shorter, so as long as none opens, such a route is still a shortest one, and there is no need
// to search again.
Hop search_first_hop(const Search *search, const Map *map, View view, Pose pose);

// The pose after a hop. The robot turns to its heading, unless that is behind it; then it drives
// backwards.
Pose pose_hopped(Pose pose, Hop hop);

#endif
