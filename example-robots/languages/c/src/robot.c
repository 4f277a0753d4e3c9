// The flood robot: drives along a shortest path to the goal, taking unknown walls for open ones,
// resets in the goal, and drives the shortest path that it knows.
#include "wasmouse/robot.h"
#include "wasmouse/search.h"
#include "wasmouse/tracker.h"

static Tracker tracker;
static Search to_goal;

// Where the last hop leads, if it was part of a route that was whole.
static Pose expected;
static bool on_route;

void robot_start(const Briefing *briefing) {
  if (briefing->variant != 0) robot_panic("this robot has only the variant 0");
  tracker_init(&tracker, briefing);
  search_init(&to_goal, briefing->longest_move);
}

// The first step of a shortest path. Searches only when the path of the last search is no longer
// whole: walls that close make nothing shorter.
static Action drive_to_goal(View view) {
  const Map *map = &tracker.map;
  Pose pose = tracker.pose;
  bool as_expected = on_route && cell_equal(pose.cell, expected.cell) &&
                     pose.heading == expected.heading;
  Hop hop = as_expected ? search_next_hop(&to_goal, map, view, pose)
                        : search_first_hop(&to_goal, map, view, pose);
  if (hop.cells == 0) {
    search_fill_until(&to_goal, map, view, tracker.briefing.goal, pose.cell);
    hop = search_next_hop(&to_goal, map, view, pose);
  }
  on_route = hop.cells > 0;
  if (!on_route) return tracker_turn(&tracker, TURN_RIGHT); // the goal is walled in
  expected = pose_hopped(pose, hop);
  return tracker_go(&tracker, hop.heading, hop.cells);
}

Action robot_next_move(Sensors sensors) {
  if (tracker_observe(&tracker, sensors) > 0) on_route = false;
  if (tracker.run == RUN_SPEED) return drive_to_goal(VIEW_PESSIMISTIC);
  if (tracker_may_reset(&tracker)) {
    on_route = false;
    return tracker_reset(&tracker);
  }
  return drive_to_goal(VIEW_OPTIMISTIC);
}
