#include "wasmouse/tracker.hpp"

namespace wasmouse {

Tracker::Tracker(const Briefing &briefing)
    : told(briefing), position{briefing.start, Heading::up}, seen(briefing.dimension),
      left(briefing.budget) {
  robot_assert(seen.contains(briefing.start));
}

Action Tracker::answer(Turn turn, Heading travel, int8_t advance) {
  position.cell = position.cell.toward(travel, uint32_t(advance < 0 ? -advance : advance));
  position.heading = turned(position.heading, turn);
  if (left > 0) left--;
  if (told.goal.contains(position.cell)) goal_seen = true;
  return Action::move(turn, advance);
}

Action Tracker::go(Heading heading, uint32_t cells) {
  if (cells > told.longest_move) cells = told.longest_move;
  uint32_t clear = seen.clear_cells(View::pessimistic, position.cell, heading, cells);
  for (Turn turn : all_turns)
    if (heading == turned(position.heading, turn)) return answer(turn, heading, int8_t(clear));
  if (clear == 0 && cells > 0 && seen.is_open(View::optimistic, position.cell, heading))
    return answer(Turn::right, heading, 0);
  return answer(Turn::straight, heading, int8_t(-int32_t(clear)));
}

Action Tracker::reset() {
  if (left > 0) left--;
  if (may_reset()) {
    current_run = Run::speed;
    position = {told.start, Heading::up};
    if (told.budget_scope == BudgetScope::each_run) left = told.budget;
  }
  return Action::reset();
}

} // namespace wasmouse
