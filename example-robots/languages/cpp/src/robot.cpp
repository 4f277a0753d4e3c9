// The flood robot: drives along a shortest path to the goal, taking unknown walls for open ones,
// resets in the goal, and drives the shortest path that it knows.
#include "wasmouse/robot.hpp"
#include "wasmouse/search.hpp"
#include "wasmouse/tracker.hpp"

using namespace wasmouse;

class FloodRobot {
public:
  void start(const Briefing &briefing) {
    if (briefing.variant != 0) robot_panic("this robot has only the variant 0");
    tracker = Tracker(briefing);
    to_goal = Search(briefing.longest_move);
  }

  Action next_move(Sensors sensors) {
    if (tracker.observe(sensors) > 0) on_route = false;
    if (tracker.run() == Run::speed) return drive_to_goal(View::pessimistic);
    if (tracker.may_reset()) {
      on_route = false;
      return tracker.reset();
    }
    return drive_to_goal(View::optimistic);
  }

private:
  // The first step of a shortest path. Searches only when the path of the last search is no longer
  // whole: walls that close make nothing shorter.
  Action drive_to_goal(View view) {
    const Map &map = tracker.map();
    Pose pose = tracker.pose();
    bool as_expected = on_route && pose == expected;
    Hop hop = as_expected ? to_goal.next_hop(map, view, pose) : to_goal.first_hop(map, view, pose);
    if (!hop) {
      to_goal.fill_until(map, view, tracker.briefing().goal, pose.cell);
      hop = to_goal.next_hop(map, view, pose);
    }
    on_route = bool(hop);
    if (!hop) return tracker.turn(Turn::right); // the goal is walled in
    expected = hop.from(pose);
    return tracker.go(hop.heading, hop.cells);
  }

  Tracker tracker;
  Search to_goal;
  // Where the last hop leads, if it was part of a route that was whole.
  Pose expected;
  bool on_route = false;
};

WASMOUSE_ROBOT(FloodRobot)
