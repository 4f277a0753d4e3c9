// The robot as the host sees it: wasmouse.h, which is generated from the interface, has the exports
// and imports, and this file has what the robot calls them.
#include "wasmouse/robot.h"
#include "wasmouse/wasmouse.h"

static void on_start(const wm_briefing *told) {
  Briefing briefing = {
      .dimension = told->dimension,
      .start = {told->start.x, told->start.y},
      .goal = {{told->goal.origin.x, told->goal.origin.y}, told->goal.width, told->goal.height},
      .budget = told->budget,
      .budget_scope = (BudgetScope)told->budget_scope,
      .longest_move = told->longest_move,
      .units_per_cell = told->units_per_cell,
      .exploration_divisor = told->exploration_divisor,
      .seed = told->seed,
      .variant = told->variant,
  };
  robot_start(&briefing);
}

static wm_action on_move(wm_sensors readings) {
  Action action = robot_next_move((Sensors){readings.left, readings.front, readings.right});
  if (action.kind == ACTION_RESET) return wm_reset();
  return wm_move((wm_turn)action.turn, action.advance);
}

WM_ROBOT(on_start, on_move);

void journal_log(Level level, const char *message) {
  wm_journal_log((wm_level)level, message, wm_length(message));
}

void journal_paint(Cell cell, Color color) {
  wm_journal_paint(cell.x, cell.y, (wm_color)color);
}

void journal_label(Cell cell, const char *text) {
  wm_journal_label(cell.x, cell.y, text, wm_length(text));
}

void journal_wall(Cell cell, Heading side, Wall belief) {
  wm_journal_wall(cell.x, cell.y, (wm_heading)side, (wm_belief)belief);
}

// Adds text, as far as there is room for it.
static size_t append(char *buffer, size_t length, size_t capacity, const char *text) {
  while (*text != '\0' && length < capacity) buffer[length++] = *text++;
  return length;
}

_Noreturn void robot_panic_at(const char *message, const char *file, int line) {
  static char buffer[2000];
  char digits[12];
  char *number = digits + sizeof digits - 1;
  *number = '\0';
  do *--number = (char)('0' + line % 10);
  while ((line /= 10) > 0);
  const char *parts[] = {message, " (", file, ":", number, ")"};
  size_t length = 0;
  for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
    length = append(buffer, length, sizeof buffer, parts[i]);
  wm_journal_panic(buffer, length);
}
