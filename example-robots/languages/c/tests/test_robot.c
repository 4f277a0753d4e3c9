// Run with `make test`.
#undef NDEBUG
#include <assert.h>
#include <stdio.h>

#include "tests/arena.h"
#include "wasmouse/search.h"

// The readings of a corridor: the map has them on both sides of each wall.
static void test_map(void) {
  static Map map;
  map_init(&map, 12);
  uint32_t closed = map_observe(&map, (Pose){{0, 0}, HEADING_UP}, (Sensors){0, 2, 0});
  assert(closed == 2); // to the right, and ahead of the third cell; the perimeter is known
  assert(map_wall(&map, (Cell){0, 2}, HEADING_DOWN) == WALL_OPEN);
  assert(map_wall(&map, (Cell){0, 3}, HEADING_DOWN) == WALL_CLOSED);
  assert(map_wall(&map, (Cell){0, 2}, HEADING_RIGHT) == WALL_UNKNOWN);
}

// A step drives up to three cells.
static void test_search(void) {
  static Map map;
  static Search search;
  map_init(&map, 12);
  search_init(&search, 3);
  Pose start = {{0, 0}, HEADING_UP};
  search_fill_until(&search, &map, VIEW_OPTIMISTIC, (Area){{5, 0}, 1, 1}, start.cell);
  assert(search_steps(&search, start.cell) == 2);
  Hop hop = search_next_hop(&search, &map, VIEW_OPTIMISTIC, start);
  assert(hop.heading == HEADING_RIGHT && hop.cells == 3);
}

static void test_match(void) {
  Played played = play("tests/maze.txt");
  printf("exploration %u steps, speed run %u steps, %u bumps\n", played.exploration_steps,
         played.speed_steps, played.bumps);
  assert(played.finished && played.bumps == 0);
  assert(played.exploration_steps == 31 && played.speed_steps == 21);
}

int main(void) {
  test_map();
  test_search();
  test_match();
  puts("all tests passed");
}
