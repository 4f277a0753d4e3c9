// The robot as the host sees it: wasmouse.h, which is generated from the interface, has the exports
// and imports, and this file has what the robot calls them.
#include "wasmouse/robot.hpp"
#include "wasmouse/wasmouse.h"

#ifndef __wasi__
// Runs the constructors of global objects; the linker makes it.
extern "C" void __wasm_call_ctors();

// Global objects are never destroyed: a match ends with its instance.
extern "C" int __cxa_atexit(void (*)(void *), void *, void *) {
  return 0;
}
void *__dso_handle = nullptr;

extern "C" void __cxa_pure_virtual() {
  robot_panic("a pure virtual function was called");
}
#endif

static void on_start(const wm_briefing *told) {
#ifndef __wasi__
  __wasm_call_ctors();
#endif
  wasmouse::start_robot({
      .dimension = told->dimension,
      .start = {told->start.x, told->start.y},
      .goal = {{told->goal.origin.x, told->goal.origin.y}, told->goal.width, told->goal.height},
      .budget = told->budget,
      .budget_scope = wasmouse::BudgetScope(told->budget_scope),
      .longest_move = told->longest_move,
      .units_per_cell = told->units_per_cell,
      .exploration_divisor = told->exploration_divisor,
      .seed = told->seed,
      .variant = told->variant,
  });
}

static wm_action on_move(wm_sensors readings) {
  auto action = wasmouse::next_move_of_robot({readings.left, readings.front, readings.right});
  if (action.kind == wasmouse::Action::Kind::reset) return wm_reset();
  return wm_move(wm_turn(action.turn), action.advance);
}

WM_ROBOT(on_start, on_move);

void wasmouse::log(Level level, const char *message) {
  wm_journal_log(wm_level(level), message, wm_length(message));
}

void wasmouse::paint(Cell cell, Color color) {
  wm_journal_paint(cell.x, cell.y, wm_color(color));
}

void wasmouse::label(Cell cell, const char *text) {
  wm_journal_label(cell.x, cell.y, text, wm_length(text));
}

void wasmouse::believe(Cell cell, Heading side, Wall wall) {
  wm_journal_wall(cell.x, cell.y, wm_heading(side), wm_belief(wall));
}

void wasmouse::panic_at(const char *message, const char *file, int line) {
  static char buffer[2000];
  char digits[12];
  char *number = digits + sizeof digits - 1;
  *number = '\0';
  do *--number = char('0' + line % 10);
  while ((line /= 10) > 0);
  size_t length = 0;
  const char *parts[] = {message, " (", file, ":", number, ")"};
  for (const char *part : parts)
    for (; *part != '\0' && length < sizeof buffer; part++) buffer[length++] = *part;
  wm_journal_panic(buffer, length);
}
