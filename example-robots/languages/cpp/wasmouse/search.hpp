// The fewest steps from every cell to a goal. One step drives up to the longest move in a straight
// line, in any direction, so the heading does not matter.
#pragma once

#include "wasmouse/map.hpp"

namespace wasmouse {

// A drive in a direction of the maze.
struct Hop {
  Heading heading = Heading::up;
  uint32_t cells = 0; // 0 where there is none

  explicit operator bool() const {
    return cells > 0;
  }

  // The pose after it. The robot turns to its heading, unless that is behind it; then it drives
  // backwards.
  Pose from(Pose pose) const {
    bool is_behind = heading == opposite(pose.heading);
    return {pose.cell.toward(heading, cells), is_behind ? pose.heading : heading};
  }
};

// The distances of the last search.
class Search {
public:
  // What `steps` is for cells that the last search did not reach.
  static constexpr uint16_t not_reached = 0xFFFF;

  // Nothing is reached yet.
  explicit Search(uint32_t longest_move = 1);

  // Computes the distance of every cell to the goal, until that of `from` is known: all cells at
  // most as far as `from` are known then, and the others count as not reached.
  void fill_until(const Map &map, View view, Area goal, Cell from);

  uint16_t steps(Cell cell) const {
    return distances[cell.x][cell.y];
  }

  // The next hop of a shortest route; none if the last search knows none, or in the goal. Between
  // routes of equal length it prefers to drive straight, then right, left, backwards; then longer
  // hops to shorter ones.
  Hop next_hop(const Map &map, View view, Pose pose) const;

  // The same, provided that the whole route still leads to the goal. Walls that close make no route
  // shorter, so as long as none opens, such a route is still a shortest one, and there is no need
  // to search again.
  Hop first_hop(const Map &map, View view, Pose pose) const;

private:
  uint32_t longest_hop(const Map &map, View view, Cell cell, Heading heading, uint16_t goal) const;
  void forget();

  uint32_t longest_move;
  uint16_t distances[dimension_max][dimension_max]; // by x and y
  Cell queue[dimension_max * dimension_max];
};

} // namespace wasmouse
