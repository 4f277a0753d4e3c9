// What a robot implements, and what it can ask of the host. A robot is two functions:
//
//     void robot_start(const Briefing *briefing);   // once, before the first step
//     Action robot_next_move(Sensors sensors);      // once per step
//
// Each match gets a fresh instance: global variables are zero or as initialised.
#ifndef WASMOUSE_ROBOT_H
#define WASMOUSE_ROBOT_H

#include "wasmouse/geometry.h"

// How far the robot could drive in each direction before a wall stops it, in cells. 0 is a wall
// directly at that side. There is no rear sensor.
typedef struct {
  uint32_t left, front, right;
} Sensors;

typedef enum { BUDGET_BOTH_RUNS, BUDGET_EACH_RUN } BudgetScope;

// Everything that a robot is told before its first step.
typedef struct {
  uint32_t dimension; // the maze has dimension x dimension cells: 2 to 64
  Cell start;         // where both runs start
  Area goal;          // in contest mazes the 2 x 2 room in the centre
  uint32_t budget;    // how many steps the robot may take
  BudgetScope budget_scope;
  uint32_t longest_move;        // the longest move in one step, in cells
  uint32_t units_per_cell;      // 1 in all current rulesets
  uint32_t exploration_divisor; // divides the steps of the exploration run in the score
  uint64_t seed;                // the only source of randomness
  uint32_t variant;             // selects a variant of the robot
} Briefing;

typedef enum { ACTION_MOVE, ACTION_RESET } ActionKind;

// What the robot does in one step: turn and then drive, or begin the speed run.
typedef struct {
  ActionKind kind;
  Turn turn;      // of a move
  int8_t advance; // of a move, in cells; negative drives backwards
} Action;

static inline Action action_move(Turn turn, int8_t advance) {
  return (Action){ACTION_MOVE, turn, advance};
}

static inline Action action_reset(void) {
  return (Action){ACTION_RESET, TURN_STRAIGHT, 0};
}

// Implemented by the robot.
void robot_start(const Briefing *briefing);
Action robot_next_move(Sensors sensors);

// The journal: how a robot reports to people. `wasmouse run --explain` and the web page show it.
typedef enum { LEVEL_DEBUG, LEVEL_INFO, LEVEL_WARNING, LEVEL_ERROR } Level;
typedef enum {
  COLOR_NONE, COLOR_RED, COLOR_ORANGE, COLOR_YELLOW, COLOR_GREEN,
  COLOR_CYAN, COLOR_BLUE, COLOR_VIOLET, COLOR_GRAY,
} Color;
typedef enum { WALL_UNKNOWN, WALL_OPEN, WALL_CLOSED } Wall;

void journal_log(Level level, const char *message);             // a line of text
void journal_paint(Cell cell, Color color);                     // colours a cell
void journal_label(Cell cell, const char *text);                // at most 8 characters in a cell
void journal_wall(Cell cell, Heading side, Wall belief);        // what the robot believes

// Ends the match with the message and its place in the source. Does not return.
#define robot_panic(message) robot_panic_at(message, __FILE__, __LINE__)
_Noreturn void robot_panic_at(const char *message, const char *file, int line);

// Ends the match unless the condition holds.
#define robot_assert(condition) \
  ((condition) ? (void)0 : robot_panic("assertion failed: " #condition))

#endif
