#include "wasmouse/search.hpp"

namespace wasmouse {

Search::Search(uint32_t longest_move) : longest_move(longest_move) {
  forget();
}

void Search::forget() {
  for (auto &column : distances)
    for (uint16_t &steps : column) steps = not_reached;
}

void Search::fill_until(const Map &map, View view, Area goal, Cell from) {
  uint32_t head = 0, tail = 0;
  auto reach = [&](Cell cell, uint16_t steps) {
    if (this->steps(cell) != not_reached) return;
    distances[cell.x][cell.y] = steps;
    queue[tail++] = cell;
  };
  forget();
  for (uint32_t x = 0; x < goal.width; x++)
    for (uint32_t y = 0; y < goal.height; y++) reach({goal.origin.x + x, goal.origin.y + y}, 0);
  while (head < tail) {
    Cell cell = queue[head++];
    if (steps(cell) >= steps(from)) return; // everything as far as `from` is known
    for (Heading heading : all_headings) {
      Cell there = cell;
      for (uint32_t cells = 0; cells < longest_move; cells++) {
        if (!map.is_open(view, there, heading)) break;
        there = there.toward(heading, 1);
        reach(there, steps(cell) + 1);
      }
    }
  }
}

// The longest drive in that direction that ends `goal` steps from the goal, or 0.
uint32_t Search::longest_hop(const Map &map, View view, Cell cell, Heading heading,
                             uint16_t goal) const {
  uint32_t longest = 0;
  for (uint32_t cells = 1; cells <= longest_move; cells++) {
    if (!map.is_open(view, cell, heading)) break;
    cell = cell.toward(heading, 1);
    if (steps(cell) == goal) longest = cells;
  }
  return longest;
}

Hop Search::next_hop(const Map &map, View view, Pose pose) const {
  uint16_t distance = steps(pose.cell);
  if (distance == 0 || distance == not_reached) return {};
  const Heading order[] = {pose.heading, turned(pose.heading, Turn::right),
                           turned(pose.heading, Turn::left), opposite(pose.heading)};
  for (Heading heading : order) {
    uint32_t cells = longest_hop(map, view, pose.cell, heading, distance - 1);
    if (cells > 0) return {heading, cells};
  }
  return {};
}

Hop Search::first_hop(const Map &map, View view, Pose pose) const {
  Hop first = next_hop(map, view, pose);
  for (Hop hop = first; hop; hop = next_hop(map, view, pose)) pose = hop.from(pose);
  return steps(pose.cell) == 0 ? first : Hop{};
}

} // namespace wasmouse
