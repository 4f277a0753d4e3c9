// What a robot implements, and what it can ask of the host. A robot is a class with two functions,
// and a line that exports it:
//
//     struct MyRobot {
//       void start(const wasmouse::Briefing &briefing);            // once, before the first step
//       wasmouse::Action next_move(wasmouse::Sensors sensors);     // once per step
//     };
//     WASMOUSE_ROBOT(MyRobot)
//
// Each match gets a fresh instance.
#pragma once

#include <stddef.h>

#include "wasmouse/geometry.hpp"

namespace wasmouse {

// How far the robot could drive in each direction before a wall stops it, in cells. 0 is a wall
// directly at that side. There is no rear sensor.
struct Sensors {
  uint32_t left, front, right;
};

enum class BudgetScope : uint32_t { both_runs, each_run };

// Everything that a robot is told before its first step.
struct Briefing {
  uint32_t dimension;           // the maze has dimension x dimension cells: 2 to 64
  Cell start;                   // where both runs start
  Area goal;                    // in contest mazes the 2 x 2 room in the centre
  uint32_t budget;              // how many steps the robot may take
  BudgetScope budget_scope;     // whether the runs share the budget
  uint32_t longest_move;        // the longest move in one step, in cells
  uint32_t units_per_cell;      // 1 in all current rulesets
  uint32_t exploration_divisor; // divides the steps of the exploration run in the score
  uint64_t seed;                // the only source of randomness
  uint32_t variant;             // selects a variant of the robot
};

// What the robot does in one step: turn and then drive, or begin the speed run.
struct Action {
  enum class Kind : uint8_t { move, reset } kind;
  Turn turn;      // of a move
  int8_t advance; // of a move, in cells; negative drives backwards

  static constexpr Action move(Turn turn, int8_t advance) {
    return {Kind::move, turn, advance};
  }
  static constexpr Action reset() {
    return {Kind::reset, Turn::straight, 0};
  }
};

// The journal: how a robot reports to people. `wasmouse run --explain` and the web page show it.
enum class Level : uint32_t { debug, info, warning, error };
enum class Color : uint32_t { none, red, orange, yellow, green, cyan, blue, violet, gray };
enum class Wall : uint32_t { unknown, open, closed };

void log(Level level, const char *message);       // a line of text
void paint(Cell cell, Color color);               // colours a cell
void label(Cell cell, const char *text);          // at most 8 characters in a cell
void believe(Cell cell, Heading side, Wall wall); // what the robot believes about a wall

// Ends the match with a message and its place in the source; see `robot_panic`.
[[noreturn]] void panic_at(const char *message, const char *file, int line);

// Implemented by WASMOUSE_ROBOT.
void start_robot(const Briefing &briefing);
Action next_move_of_robot(Sensors sensors);

} // namespace wasmouse

// Ends the match with a message.
#define robot_panic(message) ::wasmouse::panic_at(message, __FILE__, __LINE__)

// Ends the match unless the condition holds.
#define robot_assert(condition) \
  ((condition) ? (void)0 : robot_panic("assertion failed: " #condition))

// Makes a class the robot of this module.
#define WASMOUSE_ROBOT(Robot) \
  static Robot exported_robot; \
  void wasmouse::start_robot(const wasmouse::Briefing &briefing) { exported_robot.start(briefing); } \
  wasmouse::Action wasmouse::next_move_of_robot(wasmouse::Sensors sensors) { \
    return exported_robot.next_move(sensors); \
  }
