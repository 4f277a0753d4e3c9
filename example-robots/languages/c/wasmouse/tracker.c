#include "wasmouse/tracker.h"

void tracker_init(Tracker *tracker, const Briefing *briefing) {
  tracker->briefing = *briefing;
  tracker->pose = (Pose){briefing->start, HEADING_UP};
  map_init(&tracker->map, briefing->dimension);
  robot_assert(map_contains(&tracker->map, briefing->start));
  tracker->run = RUN_EXPLORATION;
  tracker->goal_seen = false;
  tracker->steps_left = briefing->budget;
}

uint32_t tracker_observe(Tracker *tracker, Sensors sensors) {
  return map_observe(&tracker->map, tracker->pose, sensors);
}

static Action answer(Tracker *tracker, Turn turn, Heading travel, int8_t advance) {
  uint32_t cells = (uint32_t)(advance < 0 ? -advance : advance);
  tracker->pose.heading = heading_turned(tracker->pose.heading, turn);
  tracker->pose.cell = cell_toward(tracker->pose.cell, travel, cells);
  if (tracker->steps_left > 0) tracker->steps_left--;
  if (area_contains(tracker->briefing.goal, tracker->pose.cell)) tracker->goal_seen = true;
  return action_move(turn, advance);
}

Action tracker_go(Tracker *tracker, Heading heading, uint32_t cells) {
  const Map *map = &tracker->map;
  Pose pose = tracker->pose;
  if (cells > tracker->briefing.longest_move) cells = tracker->briefing.longest_move;
  uint32_t clear = map_clear_cells(map, VIEW_PESSIMISTIC, pose.cell, heading, cells);
  if (heading == heading_opposite(pose.heading)) {
    if (clear == 0 && cells > 0 && map_is_open(map, VIEW_OPTIMISTIC, pose.cell, heading))
      return answer(tracker, TURN_RIGHT, heading, 0);
    return answer(tracker, TURN_STRAIGHT, heading, (int8_t)-(int8_t)clear);
  }
  Turn turn = TURN_STRAIGHT;
  if (heading == heading_turned(pose.heading, TURN_LEFT)) turn = TURN_LEFT;
  if (heading == heading_turned(pose.heading, TURN_RIGHT)) turn = TURN_RIGHT;
  return answer(tracker, turn, heading, (int8_t)clear);
}

Action tracker_turn(Tracker *tracker, Turn turn) {
  return answer(tracker, turn, tracker->pose.heading, 0);
}

Action tracker_reset(Tracker *tracker) {
  if (tracker->steps_left > 0) tracker->steps_left--;
  if (tracker_may_reset(tracker)) {
    tracker->run = RUN_SPEED;
    tracker->pose = (Pose){tracker->briefing.start, HEADING_UP};
    if (tracker->briefing.budget_scope == BUDGET_EACH_RUN)
      tracker->steps_left = tracker->briefing.budget;
  }
  return action_reset();
}

bool tracker_may_reset(const Tracker *tracker) {
  return tracker->run == RUN_EXPLORATION && tracker->goal_seen;
}
