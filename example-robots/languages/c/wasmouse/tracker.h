// The robot's position, the walls that it has seen, and the run that it is in.
#ifndef WASMOUSE_TRACKER_H
#define WASMOUSE_TRACKER_H

#include "wasmouse/map.h"

typedef enum { RUN_EXPLORATION, RUN_SPEED } Run;

// Stays correct as long as the robot returns only actions from `tracker_go`, `tracker_turn` and
// `tracker_reset`. Moves are limited to what is known to be open, so the robot never bumps.
typedef struct {
  Briefing briefing;
  Pose pose;
  Map map;
  Run run;
  bool goal_seen;      // a step of the exploration run has ended in the goal
  uint32_t steps_left; // of the current budget, including this one
} Tracker;

void tracker_init(Tracker *tracker, const Briefing *briefing);

// Adds the readings of this step to the map. Returns how many closed walls are new.
uint32_t tracker_observe(Tracker *tracker, Sensors sensors);

// The action that drives up to `cells` cells in that direction of the maze, limited to cells known
// to be reachable and to the longest move. It drives backwards if the direction is behind the
// robot; if the nearest wall there is unknown, it turns right on the spot to see it.
Action tracker_go(Tracker *tracker, Heading heading, uint32_t cells);

// The action that only turns.
Action tracker_turn(Tracker *tracker, Turn turn);

// The reset, which begins the speed run in the start cell.
Action tracker_reset(Tracker *tracker);

// Whether the host accepts a reset: in the exploration run, after a step has ended in the goal.
bool tracker_may_reset(const Tracker *tracker);

#endif
