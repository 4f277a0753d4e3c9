#include "wasmouse/search.h"

void search_init(Search *search, uint32_t longest_move) {
  search->longest_move = longest_move;
  for (int x = 0; x < DIMENSION_MAX; x++)
    for (int y = 0; y < DIMENSION_MAX; y++) search->steps[x][y] = NOT_REACHED;
}

void search_fill_until(Search *search, const Map *map, View view, Area goal, Cell from) {
  static Cell queue[DIMENSION_MAX * DIMENSION_MAX];
  uint32_t head = 0, tail = 0;
  search_init(search, search->longest_move);
  for (uint32_t x = 0; x < goal.width; x++)
    for (uint32_t y = 0; y < goal.height; y++) {
      Cell cell = {goal.origin.x + x, goal.origin.y + y};
      search->steps[cell.x][cell.y] = 0;
      queue[tail++] = cell;
    }
  while (head < tail) {
    Cell cell = queue[head++];
    uint16_t steps = search_steps(search, cell);
    if (steps >= search_steps(search, from)) return; // everything as far as `from` is known
    for (int heading = 0; heading < HEADINGS; heading++) {
      Cell there = cell;
      for (uint32_t cells = 0; cells < search->longest_move; cells++) {
        if (!map_is_open(map, view, there, (Heading)heading)) break;
        there = cell_toward(there, (Heading)heading, 1);
        if (search_steps(search, there) == NOT_REACHED) {
          search->steps[there.x][there.y] = steps + 1;
          queue[tail++] = there;
        }
      }
    }
  }
}

// The longest drive in that direction that ends `goal` steps from the goal, or 0.
static uint32_t longest_hop(const Search *search, const Map *map, View view, Cell cell,
                            Heading heading, uint16_t goal) {
  uint32_t longest = 0;
  for (uint32_t cells = 1; cells <= search->longest_move; cells++) {
    if (!map_is_open(map, view, cell, heading)) break;
    cell = cell_toward(cell, heading, 1);
    if (search_steps(search, cell) == goal) longest = cells;
  }
  return longest;
}

Hop search_next_hop(const Search *search, const Map *map, View view, Pose pose) {
  uint16_t steps = search_steps(search, pose.cell);
  const Heading order[HEADINGS] = {
      pose.heading,
      heading_turned(pose.heading, TURN_RIGHT),
      heading_turned(pose.heading, TURN_LEFT),
      heading_opposite(pose.heading),
  };
  if (steps != 0 && steps != NOT_REACHED)
    for (int i = 0; i < HEADINGS; i++) {
      uint32_t cells = longest_hop(search, map, view, pose.cell, order[i], steps - 1);
      if (cells > 0) return (Hop){order[i], cells};
    }
  return (Hop){pose.heading, 0};
}

Hop search_first_hop(const Search *search, const Map *map, View view, Pose pose) {
  Hop first = search_next_hop(search, map, view, pose);
  for (Hop hop = first; hop.cells > 0; hop = search_next_hop(search, map, view, pose))
    pose = pose_hopped(pose, hop);
  return search_steps(search, pose.cell) == 0 ? first : (Hop){pose.heading, 0};
}

Pose pose_hopped(Pose pose, Hop hop) {
  if (hop.heading != heading_opposite(pose.heading)) pose.heading = hop.heading;
  pose.cell = cell_toward(pose.cell, hop.heading, hop.cells);
  return pose;
}
