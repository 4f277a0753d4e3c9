/* Generated from wit/robot.wit (wasmouse:robot@0.2.0) by `cargo xtask bindings`. Do not edit.
 *
 * The interface of a robot in C (C11) or C++ (C++17). It needs no library.
 *
 *     #include "wasmouse.h"
 *
 *     static void start(const wm_briefing *briefing) {
 *       (void)briefing;
 *     }
 *
 *     static wm_action next_move(wm_sensors sensors) {
 *       if (sensors.left > 0) return wm_move(WM_TURN_LEFT, 1);
 *       if (sensors.front > 0) return wm_move(WM_TURN_STRAIGHT, 1);
 *       return wm_move(WM_TURN_RIGHT, sensors.right > 0 ? 1 : 0);
 *     }
 *
 *     WM_ROBOT(start, next_move);
 *
 * Build it with one of
 *
 *     clang --target=wasm32 -O2 -nostdlib -Wl,--no-entry -o robot.wasm robot.c
 *     zig cc --target=wasm32-freestanding -O2 -nostdlib -Wl,--no-entry -o robot.wasm robot.c
 *
 * and play it with `wasmouse run robot.wasm`.
 *
 * Without WebAssembly (`__wasm__` is not defined) the attributes for imports and
 * exports are left out: a unit test of the robot calls `start` and `next_move`, or
 * `wm_start` and `wm_next_move`, and defines those `wm_journal_...` functions that
 * the robot calls. docs/ABI.md has the same interface without C.
 */
#ifndef WASMOUSE_H
#define WASMOUSE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __wasm__
#define WM_EXPORT(name) __attribute__((export_name(name)))
#define WM_IMPORT(module, name) __attribute__((import_module(module), import_name(name)))
#else
#define WM_EXPORT(name)
#define WM_IMPORT(module, name)
#endif

#if defined(__GNUC__)
#define WM_NORETURN __attribute__((noreturn))
#else
#define WM_NORETURN
#endif

#ifdef __cplusplus
#define WM_STATIC_ASSERT(condition) static_assert(condition, #condition)
extern "C" {
#else
#define WM_STATIC_ASSERT(condition) _Static_assert(condition, #condition)
#endif

/* ---- Types ---- */

/**
 * What the robot senses in its current position before it acts: in each
 * direction relative to its heading, how far it could drive before a wall stops
 * it. 0 means a wall directly at that side. There is no rear sensor. Unit:
 * units. In all current rulesets the readings are exact and range from 0 to
 * `briefing.dimension` - 1.
 */
typedef struct wm_sensors {
  /** Free distance to the left of the robot. */
  uint32_t left;
  /** Free distance ahead of the robot. */
  uint32_t front;
  /** Free distance to the right of the robot. */
  uint32_t right;
} wm_sensors;
WM_STATIC_ASSERT(sizeof(wm_sensors) == 12);
WM_STATIC_ASSERT(offsetof(wm_sensors, left) == 0);
WM_STATIC_ASSERT(offsetof(wm_sensors, front) == 4);
WM_STATIC_ASSERT(offsetof(wm_sensors, right) == 8);

/** A rotation on the spot, done before the robot moves. */
typedef enum wm_turn {
  /** A quarter turn counterclockwise (-90 degrees). */
  WM_TURN_LEFT = 0,
  /** No rotation. */
  WM_TURN_STRAIGHT = 1,
  /** A quarter turn clockwise (+90 degrees). */
  WM_TURN_RIGHT = 2,
} wm_turn;

/** What the robot does in one step. Every action takes one step. */
typedef struct wm_action {
  /** Which: a `WM_ACTION_...`. */
  uint8_t kind;
  /** The rotation, done first. Only where `kind` is `WM_ACTION_MOVE`. */
  uint8_t turn;
  /**
   * How far to drive after the rotation. Unit: units. Negative drives backwards
   * with the heading unchanged. The host clamps it to -`briefing.longest_move`
   * ..= `briefing.longest_move` and counts the clamp. At the first wall the
   * robot stops and keeps the distance it has covered, and the host counts a
   * bump. Neither costs anything extra. Only where `kind` is `WM_ACTION_MOVE`.
   */
  int8_t advance;
} wm_action;
WM_STATIC_ASSERT(sizeof(wm_action) == 3);
WM_STATIC_ASSERT(offsetof(wm_action, turn) == 1);
WM_STATIC_ASSERT(offsetof(wm_action, advance) == 2);

/** The values of `kind` of a `wm_action`. */
typedef enum wm_action_kind {
  /** Turn, then drive. */
  WM_ACTION_MOVE = 0,
  /**
   * End the exploration run and begin the speed run in the start cell, heading
   * up. The reset itself is a step of the exploration run. It is ignored (the
   * robot stays where it is and the step is spent) until a step of the
   * exploration run has ended in the goal, and throughout the speed run.
   */
  WM_ACTION_RESET = 1,
} wm_action_kind;

/**
 * Turn, then drive. `advance` is limited to -128 ..= 127, which is what fits.
 */
static inline wm_action wm_move(wm_turn turn, int advance) {
  wm_action value;
  value.kind = WM_ACTION_MOVE;
  value.turn = (uint8_t)turn;
  value.advance = (int8_t)(advance < -128 ? -128 : advance > 127 ? 127 : advance);
  return value;
}

/**
 * End the exploration run and begin the speed run in the start cell, heading
 * up. The reset itself is a step of the exploration run. It is ignored (the
 * robot stays where it is and the step is spent) until a step of the
 * exploration run has ended in the goal, and throughout the speed run.
 */
static inline wm_action wm_reset(void) {
  wm_action value;
  value.kind = WM_ACTION_RESET;
  value.turn = 0;
  value.advance = 0;
  return value;
}

/**
 * A cell of the maze. `x` grows to the right, `y` grows upward, and (0, 0) is
 * the bottom left corner.
 */
typedef struct wm_cell {
  /** Column, counted from the left, starting at 0. */
  uint32_t x;
  /** Row, counted from the bottom, starting at 0. */
  uint32_t y;
} wm_cell;
WM_STATIC_ASSERT(sizeof(wm_cell) == 8);
WM_STATIC_ASSERT(offsetof(wm_cell, x) == 0);
WM_STATIC_ASSERT(offsetof(wm_cell, y) == 4);

/** A rectangle of cells. */
typedef struct wm_area {
  /** The bottom left cell of the rectangle. */
  wm_cell origin;
  /** Unit: cells. */
  uint32_t width;
  /** Unit: cells. */
  uint32_t height;
} wm_area;
WM_STATIC_ASSERT(sizeof(wm_area) == 16);
WM_STATIC_ASSERT(offsetof(wm_area, origin) == 0);
WM_STATIC_ASSERT(offsetof(wm_area, width) == 8);
WM_STATIC_ASSERT(offsetof(wm_area, height) == 12);

/** A direction in the maze, independent of the robot. */
typedef enum wm_heading {
  /** Towards larger `y`. The robot starts both runs with this heading. */
  WM_HEADING_UP = 0,
  /** Towards larger `x`. */
  WM_HEADING_RIGHT = 1,
  /** Towards smaller `y`. */
  WM_HEADING_DOWN = 2,
  /** Towards smaller `x`. */
  WM_HEADING_LEFT = 3,
} wm_heading;

/** How `briefing.budget` applies to the two runs. */
typedef enum wm_budget_scope {
  /** The two runs share the budget. */
  WM_BUDGET_SCOPE_BOTH_RUNS = 0,
  /** Each run has the whole budget for itself. */
  WM_BUDGET_SCOPE_EACH_RUN = 1,
} wm_budget_scope;

/**
 * Everything a robot is told before its first step.
 *
 * A match has an exploration run and then a speed run. The speed run ends with
 * the first step that ends in a goal cell; passing through one does not count.
 * The score is the number of steps in the speed run plus the number of steps in
 * the exploration run divided by `exploration_divisor`. Lower is better.
 */
typedef struct wm_briefing {
  /**
   * The maze has `dimension` x `dimension` cells. Range: 2 to 64, or 0 if the
   * track does not tell. All current rulesets tell it; in contest mazes it is
   * an even number from 12 to 20.
   */
  uint32_t dimension;
  /** The cell where both runs start. In contest mazes (0, 0). */
  wm_cell start;
  /**
   * The goal cells. In contest mazes the 2 x 2 room in the centre. A `width`
   * and a `height` of 0 mean that the track does not tell; all current rulesets
   * tell it.
   */
  wm_area goal;
  /**
   * How many steps the robot may take. Unit: steps. Range: 1 to 1,000,000; the
   * ruleset `udacity` sets 1,000. The step numbered `budget` is still executed.
   */
  uint32_t budget;
  /**
   * Whether the two runs share `budget` or each has all of it. A
   * `WM_BUDGET_SCOPE_...`.
   */
  uint8_t budget_scope;
  /**
   * The longest move in one step, forwards or backwards. Unit: units. Range: 1
   * to 127. The ruleset `udacity` sets 3.
   */
  uint32_t longest_move;
  /**
   * The distance from the centre of a cell to that of the next one. Unit:
   * units. At least 1, and 1 in all current rulesets. A robot that assumes 1
   * should trap on any other value.
   */
  uint32_t units_per_cell;
  /**
   * Steps of the exploration run are divided by this number in the score.
   * Range: 1 to 1,000,000; the ruleset `udacity` sets 30.
   */
  uint32_t exploration_divisor;
  /**
   * The robot's only source of randomness. The same seed in the same maze
   * always gives the same match. Range: any.
   */
  uint64_t seed;
  /**
   * Selects a variant of the robot. Each robot documents its own; the default
   * is 0. A robot should trap on a variant that it does not have. (The field's
   * name is `variant`; WIT needs the `%` before a keyword.)
   */
  uint32_t variant;
} wm_briefing;
WM_STATIC_ASSERT(sizeof(wm_briefing) == 64);
WM_STATIC_ASSERT(offsetof(wm_briefing, dimension) == 0);
WM_STATIC_ASSERT(offsetof(wm_briefing, start) == 4);
WM_STATIC_ASSERT(offsetof(wm_briefing, goal) == 12);
WM_STATIC_ASSERT(offsetof(wm_briefing, budget) == 28);
WM_STATIC_ASSERT(offsetof(wm_briefing, budget_scope) == 32);
WM_STATIC_ASSERT(offsetof(wm_briefing, longest_move) == 36);
WM_STATIC_ASSERT(offsetof(wm_briefing, units_per_cell) == 40);
WM_STATIC_ASSERT(offsetof(wm_briefing, exploration_divisor) == 44);
WM_STATIC_ASSERT(offsetof(wm_briefing, seed) == 48);
WM_STATIC_ASSERT(offsetof(wm_briefing, variant) == 56);

/** The severity of a log message. */
typedef enum wm_level {
  /** For the author of the robot. */
  WM_LEVEL_DEBUG = 0,
  /** For anyone who watches. */
  WM_LEVEL_INFO = 1,
  /** Something unexpected that the robot can handle. */
  WM_LEVEL_WARNING = 2,
  /** Something that should not have happened. */
  WM_LEVEL_ERROR = 3,
} wm_level;

/** The colour of a cell. */
typedef enum wm_color {
  /** Removes the colour of the cell. */
  WM_COLOR_NONE = 0,
  /** Red. */
  WM_COLOR_RED = 1,
  /** Orange. */
  WM_COLOR_ORANGE = 2,
  /** Yellow. */
  WM_COLOR_YELLOW = 3,
  /** Green. */
  WM_COLOR_GREEN = 4,
  /** Cyan. */
  WM_COLOR_CYAN = 5,
  /** Blue. */
  WM_COLOR_BLUE = 6,
  /** Violet. */
  WM_COLOR_VIOLET = 7,
  /** Gray. */
  WM_COLOR_GRAY = 8,
} wm_color;

/** What the robot believes about one wall. */
typedef enum wm_belief {
  /** Not known. */
  WM_BELIEF_UNKNOWN = 0,
  /** There is no wall. */
  WM_BELIEF_OPEN = 1,
  /** There is a wall. */
  WM_BELIEF_CLOSED = 2,
} wm_belief;

/* ---- What a robot exports ---- */

/**
 * Called once, before the first step. A robot that cannot take part (unknown
 * variant, a track or a maze that it does not support) traps or calls
 * `journal.panic`, and its match ends with a fault in step 0.
 *
 * @param dimension The maze has `dimension` x `dimension` cells. Range: 2 to
 *   64, or 0 if the track does not tell. All current rulesets tell it; in
 *   contest mazes it is an even number from 12 to 20.
 * @param start_x The cell where both runs start. In contest mazes (0, 0).
 *   Column, counted from the left, starting at 0.
 * @param start_y The cell where both runs start. In contest mazes (0, 0). Row,
 *   counted from the bottom, starting at 0.
 * @param goal_origin_x The goal cells. In contest mazes the 2 x 2 room in the
 *   centre. A `width` and a `height` of 0 mean that the track does not tell;
 *   all current rulesets tell it. The bottom left cell of the rectangle.
 *   Column, counted from the left, starting at 0.
 * @param goal_origin_y The goal cells. In contest mazes the 2 x 2 room in the
 *   centre. A `width` and a `height` of 0 mean that the track does not tell;
 *   all current rulesets tell it. The bottom left cell of the rectangle. Row,
 *   counted from the bottom, starting at 0.
 * @param goal_width The goal cells. In contest mazes the 2 x 2 room in the
 *   centre. A `width` and a `height` of 0 mean that the track does not tell;
 *   all current rulesets tell it. Unit: cells.
 * @param goal_height The goal cells. In contest mazes the 2 x 2 room in the
 *   centre. A `width` and a `height` of 0 mean that the track does not tell;
 *   all current rulesets tell it. Unit: cells.
 * @param budget How many steps the robot may take. Unit: steps. Range: 1 to
 *   1,000,000; the ruleset `udacity` sets 1,000. The step numbered `budget` is
 *   still executed.
 * @param budget_scope Whether the two runs share `budget` or each has all of
 *   it.
 * @param longest_move The longest move in one step, forwards or backwards.
 *   Unit: units. Range: 1 to 127. The ruleset `udacity` sets 3.
 * @param units_per_cell The distance from the centre of a cell to that of the
 *   next one. Unit: units. At least 1, and 1 in all current rulesets. A robot
 *   that assumes 1 should trap on any other value.
 * @param exploration_divisor Steps of the exploration run are divided by this
 *   number in the score. Range: 1 to 1,000,000; the ruleset `udacity` sets 30.
 * @param seed The robot's only source of randomness. The same seed in the same
 *   maze always gives the same match. Range: any.
 * @param variant Selects a variant of the robot. Each robot documents its own;
 *   the default is 0. A robot should trap on a variant that it does not have.
 *   (The field's name is `variant`; WIT needs the `%` before a keyword.)
 */
WM_EXPORT("wasmouse:robot/controller@0.2.0#start")
void wm_start(uint32_t dimension,
    uint32_t start_x,
    uint32_t start_y,
    uint32_t goal_origin_x,
    uint32_t goal_origin_y,
    uint32_t goal_width,
    uint32_t goal_height,
    uint32_t budget,
    wm_budget_scope budget_scope,
    uint32_t longest_move,
    uint32_t units_per_cell,
    uint32_t exploration_divisor,
    uint64_t seed,
    uint32_t variant);

/**
 * Called once per step with the readings at the robot's current position. A
 * trap, a turn or action number outside the enumerations above, a return
 * pointer outside memory, and running out of fuel, memory or stack each end the
 * match with a fault.
 *
 * @param left Free distance to the left of the robot.
 * @param front Free distance ahead of the robot.
 * @param right Free distance to the right of the robot.
 * @return The address of a `wm_action`, read at once.
 */
WM_EXPORT("wasmouse:robot/controller@0.2.0#next-move")
const wm_action *wm_next_move(uint32_t left,
    uint32_t front,
    uint32_t right);

/**
 * Makes a robot of two functions, `void on_start(const wm_briefing *)` and
 * `wm_action on_move(wm_sensors)`. They are called as `wm_start` and
 * `wm_next_move` are.
 */
#define WM_ROBOT(on_start, on_move)                     \
  void wm_start(uint32_t dimension,                     \
      uint32_t start_x,                                 \
      uint32_t start_y,                                 \
      uint32_t goal_origin_x,                           \
      uint32_t goal_origin_y,                           \
      uint32_t goal_width,                              \
      uint32_t goal_height,                             \
      uint32_t budget,                                  \
      wm_budget_scope budget_scope,                     \
      uint32_t longest_move,                            \
      uint32_t units_per_cell,                          \
      uint32_t exploration_divisor,                     \
      uint64_t seed,                                    \
      uint32_t variant) {                               \
    wm_briefing briefing;                               \
    briefing.dimension = dimension;                     \
    briefing.start.x = start_x;                         \
    briefing.start.y = start_y;                         \
    briefing.goal.origin.x = goal_origin_x;             \
    briefing.goal.origin.y = goal_origin_y;             \
    briefing.goal.width = goal_width;                   \
    briefing.goal.height = goal_height;                 \
    briefing.budget = budget;                           \
    briefing.budget_scope = (uint8_t)budget_scope;      \
    briefing.longest_move = longest_move;               \
    briefing.units_per_cell = units_per_cell;           \
    briefing.exploration_divisor = exploration_divisor; \
    briefing.seed = seed;                               \
    briefing.variant = variant;                         \
    on_start(&briefing);                                \
  }                                                     \
  const wm_action *wm_next_move(uint32_t left,          \
      uint32_t front,                                   \
      uint32_t right) {                                 \
    wm_sensors sensors;                                 \
    sensors.left = left;                                \
    sensors.front = front;                              \
    sensors.right = right;                              \
    static wm_action value;                             \
    value = on_move(sensors);                           \
    return &value;                                      \
  }                                                     \
  WM_STATIC_ASSERT(1)

/* ---- What a robot may import ---- */

/**
 * Writes a line of text.
 *
 * @param level
 * @param message Address of the text.
 * @param message_length Length of the text. Unit: bytes.
 */
WM_IMPORT("wasmouse:robot/journal@0.2.0", "log")
void wm_journal_log(wm_level level,
    const char *message,
    size_t message_length);

/**
 * Colours a cell. Cells outside the maze are ignored.
 *
 * @param cell_x Column, counted from the left, starting at 0.
 * @param cell_y Row, counted from the bottom, starting at 0.
 * @param color
 */
WM_IMPORT("wasmouse:robot/journal@0.2.0", "paint")
void wm_journal_paint(uint32_t cell_x,
    uint32_t cell_y,
    wm_color color);

/**
 * Writes a short text into a cell. At most 8 characters are shown; the empty
 * text removes the label. Cells outside the maze are ignored.
 *
 * @param cell_x Column, counted from the left, starting at 0.
 * @param cell_y Row, counted from the bottom, starting at 0.
 * @param text Address of the text.
 * @param text_length Length of the text. Unit: bytes.
 */
WM_IMPORT("wasmouse:robot/journal@0.2.0", "label")
void wm_journal_label(uint32_t cell_x,
    uint32_t cell_y,
    const char *text,
    size_t text_length);

/**
 * States what the robot believes about the wall on one side of a cell. Cells
 * outside the maze are ignored.
 *
 * @param cell_x Column, counted from the left, starting at 0.
 * @param cell_y Row, counted from the bottom, starting at 0.
 * @param side
 * @param belief
 */
WM_IMPORT("wasmouse:robot/journal@0.2.0", "wall")
void wm_journal_wall(uint32_t cell_x,
    uint32_t cell_y,
    wm_heading side,
    wm_belief belief);

/**
 * Reports an error from which the robot cannot recover, and ends the match with
 * the fault `panic` and this message. Does not return. The host keeps the first
 * 2,000 bytes of the message, cut at a character boundary. The message does not
 * count against the journal limit.
 *
 * Language runtimes call it where they would otherwise print a message and trap
 * (a panic, an abort, a failed assertion).
 *
 * @param message Address of the text.
 * @param message_length Length of the text. Unit: bytes.
 */
WM_IMPORT("wasmouse:robot/journal@0.2.0", "panic")
WM_NORETURN
void wm_journal_panic(const char *message,
    size_t message_length);

/* ---- The same with C's types ---- */

/** Length of a text that ends with a zero byte. Unit: bytes. */
static inline size_t wm_length(const char *text) {
  size_t length = 0;
  while (text[length] != '\0') {
    length++;
  }
  return length;
}

/** Writes a line of text. `message` ends with a zero byte. */
static inline void wm_log(wm_level level, const char *message) {
  wm_journal_log(level, message, wm_length(message));
}

/** Colours a cell. Cells outside the maze are ignored. */
static inline void wm_paint(wm_cell cell, wm_color color) {
  wm_journal_paint(cell.x, cell.y, color);
}

/**
 * Writes a short text into a cell. At most 8 characters are shown; the empty
 * text removes the label. Cells outside the maze are ignored. `text` ends with
 * a zero byte.
 */
static inline void wm_label(wm_cell cell, const char *text) {
  wm_journal_label(cell.x, cell.y, text, wm_length(text));
}

/**
 * States what the robot believes about the wall on one side of a cell. Cells
 * outside the maze are ignored.
 */
static inline void wm_wall(wm_cell cell, wm_heading side, wm_belief belief) {
  wm_journal_wall(cell.x, cell.y, side, belief);
}

/**
 * Reports an error from which the robot cannot recover, and ends the match with
 * the fault `panic` and this message. Does not return. The host keeps the first
 * 2,000 bytes of the message, cut at a character boundary. The message does not
 * count against the journal limit.
 *
 * Language runtimes call it where they would otherwise print a message and trap
 * (a panic, an abort, a failed assertion). `message` ends with a zero byte.
 */
WM_NORETURN
static inline void wm_panic(const char *message) {
  wm_journal_panic(message, wm_length(message));
}

#ifdef __cplusplus
} /* extern "C" */
#endif

#endif /* WASMOUSE_H */
