// Run with `make test`.
#undef NDEBUG
#include <cassert>
#include <iostream>

#include "tests/arena.hpp"
#include "wasmouse/search.hpp"

using namespace wasmouse;

// The readings of a corridor: the map has them on both sides of each wall.
static void test_map() {
  Map map(12);
  uint32_t closed = map.observe({{0, 0}, Heading::up}, {0, 2, 0});
  assert(closed == 2); // to the right, and ahead of the third cell; the perimeter is known
  assert(map.wall({0, 2}, Heading::down) == Wall::open);
  assert(map.wall({0, 3}, Heading::down) == Wall::closed);
  assert(map.wall({0, 2}, Heading::right) == Wall::unknown);
}

// A step drives up to three cells.
static void test_search() {
  Map map(12);
  Search search(3);
  Pose start{{0, 0}, Heading::up};
  search.fill_until(map, View::optimistic, {{5, 0}, 1, 1}, start.cell);
  assert(search.steps(start.cell) == 2);
  Hop hop = search.next_hop(map, View::optimistic, start);
  assert(hop.heading == Heading::right && hop.cells == 3);
}

static void test_match() {
  Played played = play("tests/maze.txt");
  std::cout << "exploration " << played.exploration_steps << " steps, speed run "
            << played.speed_steps << " steps, " << played.bumps << " bumps\n";
  assert(played.finished && played.bumps == 0);
  assert(played.exploration_steps == 31 && played.speed_steps == 21);
}

int main() {
  test_map();
  test_search();
  test_match();
  std::cout << "all tests passed\n";
}
