// The interface in WebAssembly: exports what the host calls, imports the journal. Numbers only; an
// action is three bytes in memory: its kind, the turn, the advance.
#include "wasmouse/robot.hpp"

#define EXPORT(name) \
  extern "C" __attribute__((export_name("wasmouse:robot/controller@0.2.0#" name)))
#define JOURNAL(name) \
  extern "C" __attribute__((import_module("wasmouse:robot/journal@0.2.0"), import_name(name)))

JOURNAL("log") void import_log(uint32_t level, const char *text, size_t bytes);
JOURNAL("paint") void import_paint(uint32_t x, uint32_t y, uint32_t color);
JOURNAL("label") void import_label(uint32_t x, uint32_t y, const char *text, size_t bytes);
JOURNAL("wall") void import_wall(uint32_t x, uint32_t y, uint32_t side, uint32_t belief);
JOURNAL("panic") void import_panic(const char *text, size_t bytes);

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

EXPORT("start")
void start(uint32_t dimension, uint32_t start_x, uint32_t start_y, uint32_t goal_x, uint32_t goal_y,
           uint32_t goal_width, uint32_t goal_height, uint32_t budget, uint32_t budget_scope,
           uint32_t longest_move, uint32_t units_per_cell, uint32_t exploration_divisor,
           uint64_t seed, uint32_t variant) {
#ifndef __wasi__
  __wasm_call_ctors();
#endif
  wasmouse::start_robot({
      .dimension = dimension,
      .start = {start_x, start_y},
      .goal = {{goal_x, goal_y}, goal_width, goal_height},
      .budget = budget,
      .budget_scope = wasmouse::BudgetScope(budget_scope),
      .longest_move = longest_move,
      .units_per_cell = units_per_cell,
      .exploration_divisor = exploration_divisor,
      .seed = seed,
      .variant = variant,
  });
}

EXPORT("next-move")
const uint8_t *next_move(uint32_t left, uint32_t front, uint32_t right) {
  static uint8_t answer[3];
  wasmouse::Action action = wasmouse::next_move_of_robot({left, front, right});
  answer[0] = uint8_t(action.kind);
  answer[1] = uint8_t(action.turn);
  answer[2] = uint8_t(action.advance);
  return answer;
}

static size_t length_of(const char *text) {
  size_t length = 0;
  while (text[length] != '\0') length++;
  return length;
}

void wasmouse::log(Level level, const char *message) {
  import_log(uint32_t(level), message, length_of(message));
}

void wasmouse::paint(Cell cell, Color color) {
  import_paint(cell.x, cell.y, uint32_t(color));
}

void wasmouse::label(Cell cell, const char *text) {
  import_label(cell.x, cell.y, text, length_of(text));
}

void wasmouse::believe(Cell cell, Heading side, Wall wall) {
  import_wall(cell.x, cell.y, uint32_t(side), uint32_t(wall));
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
  import_panic(buffer, length);
  __builtin_trap();
}
