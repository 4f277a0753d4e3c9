// The robot's position, the walls that it has seen, and the run that it is in.
#pragma once

#include "wasmouse/map.hpp"

namespace wasmouse {

enum class Run { exploration, speed };

// Stays correct as long as the robot returns only actions from `go`, `turn` and `reset`. Moves are
// limited to what is known to be open, so the robot never bumps.
class Tracker {
public:
  Tracker() = default;
  explicit Tracker(const Briefing &briefing);

  // Adds the readings of this step to the map. Returns how many closed walls are new.
  uint32_t observe(Sensors sensors) {
    return seen.observe(position, sensors);
  }

  // The action that drives up to `cells` cells in that direction of the maze, limited to cells
  // known to be reachable and to the longest move. It drives backwards if the direction is behind
  // the robot; if the nearest wall there is unknown, it turns right on the spot to see it.
  Action go(Heading heading, uint32_t cells);

  // The action that only turns.
  Action turn(Turn turn) {
    return answer(turn, position.heading, 0);
  }

  // The reset, which begins the speed run in the start cell.
  Action reset();

  // Whether the host accepts a reset: in the exploration run, after a step has ended in the goal.
  bool may_reset() const {
    return current_run == Run::exploration && goal_seen;
  }

  const Briefing &briefing() const { return told; }
  const Pose &pose() const { return position; }
  const Map &map() const { return seen; }
  Run run() const { return current_run; }

  // How many steps are left of the current budget, including this one.
  uint32_t steps_left() const { return left; }

private:
  Action answer(Turn turn, Heading travel, int8_t advance);

  Briefing told{};
  Pose position;
  Map seen;
  Run current_run = Run::exploration;
  bool goal_seen = false; // a step of the exploration run has ended in the goal
  uint32_t left = 0;
};

} // namespace wasmouse
