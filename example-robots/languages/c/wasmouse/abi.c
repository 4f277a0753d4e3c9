// The interface in WebAssembly: exports what the host calls, imports the journal. Numbers only; an
// action is three bytes in memory: its kind, the turn, the advance.
#include <stddef.h>

#include "wasmouse/robot.h"

#define EXPORT(name) __attribute__((export_name("wasmouse:robot/controller@0.2.0#" name)))
#define JOURNAL(name) \
  __attribute__((import_module("wasmouse:robot/journal@0.2.0"), import_name(name)))

JOURNAL("log") void import_log(uint32_t level, const char *text, size_t bytes);
JOURNAL("paint") void import_paint(uint32_t x, uint32_t y, uint32_t color);
JOURNAL("label") void import_label(uint32_t x, uint32_t y, const char *text, size_t bytes);
JOURNAL("wall") void import_wall(uint32_t x, uint32_t y, uint32_t side, uint32_t belief);
JOURNAL("panic") void import_panic(const char *text, size_t bytes);

EXPORT("start")
void start(uint32_t dimension, uint32_t start_x, uint32_t start_y, uint32_t goal_x, uint32_t goal_y,
           uint32_t goal_width, uint32_t goal_height, uint32_t budget, uint32_t budget_scope,
           uint32_t longest_move, uint32_t units_per_cell, uint32_t exploration_divisor,
           uint64_t seed, uint32_t variant) {
  Briefing briefing = {
      .dimension = dimension,
      .start = {start_x, start_y},
      .goal = {{goal_x, goal_y}, goal_width, goal_height},
      .budget = budget,
      .budget_scope = (BudgetScope)budget_scope,
      .longest_move = longest_move,
      .units_per_cell = units_per_cell,
      .exploration_divisor = exploration_divisor,
      .seed = seed,
      .variant = variant,
  };
  robot_start(&briefing);
}

EXPORT("next-move")
const uint8_t *next_move(uint32_t left, uint32_t front, uint32_t right) {
  static uint8_t answer[3];
  Action action = robot_next_move((Sensors){left, front, right});
  answer[0] = (uint8_t)action.kind;
  answer[1] = (uint8_t)action.turn;
  answer[2] = (uint8_t)action.advance;
  return answer;
}

static size_t length_of(const char *text) {
  size_t length = 0;
  while (text[length] != '\0') length++;
  return length;
}

void journal_log(Level level, const char *message) {
  import_log(level, message, length_of(message));
}

void journal_paint(Cell cell, Color color) {
  import_paint(cell.x, cell.y, color);
}

void journal_label(Cell cell, const char *text) {
  import_label(cell.x, cell.y, text, length_of(text));
}

void journal_wall(Cell cell, Heading side, Wall belief) {
  import_wall(cell.x, cell.y, side, belief);
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
  import_panic(buffer, length);
  __builtin_trap();
}
