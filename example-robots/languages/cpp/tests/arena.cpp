#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include "tests/arena.hpp"

using namespace wasmouse;

namespace {

struct Maze {
  uint32_t dimension = 0;
  // By x and y: a bit for each heading without a wall.
  unsigned open[dimension_max][dimension_max] = {};

  explicit Maze(const std::string &name) {
    std::ifstream file(name);
    file >> dimension;
    for (uint32_t x = 0; x < std::min(dimension, dimension_max); x++)
      for (uint32_t y = 0; y < std::min(dimension, dimension_max); y++) {
        char comma;
        if (y > 0) file >> comma;
        file >> open[x][y];
      }
    if (!file || dimension > dimension_max) throw std::runtime_error("cannot read " + name);
  }

  uint32_t clear_cells(Cell cell, Heading heading) const {
    uint32_t cells = 0;
    for (; open[cell.x][cell.y] >> unsigned(heading) & 1; cells++) cell = cell.toward(heading, 1);
    return cells;
  }
};

} // namespace

Played play(const std::string &maze_file) {
  Maze maze(maze_file);
  uint32_t centre = maze.dimension / 2 - 1;
  Briefing briefing{
      .dimension = maze.dimension,
      .start = {0, 0},
      .goal = {{centre, centre}, 2, 2},
      .budget = 1000,
      .budget_scope = BudgetScope::both_runs,
      .longest_move = 3,
      .units_per_cell = 1,
      .exploration_divisor = 30,
      .seed = 0,
      .variant = 0,
  };
  Played played;
  Pose pose{briefing.start, Heading::up};
  bool goal_seen = false, in_speed_run = false;
  start_robot(briefing);
  for (uint32_t step = 0; step < briefing.budget; step++) {
    Action action = next_move_of_robot({
        maze.clear_cells(pose.cell, turned(pose.heading, Turn::left)),
        maze.clear_cells(pose.cell, pose.heading),
        maze.clear_cells(pose.cell, turned(pose.heading, Turn::right)),
    });
    ++(in_speed_run ? played.speed_steps : played.exploration_steps);
    if (action.kind == Action::Kind::reset) {
      if (!goal_seen || in_speed_run) continue; // the host ignores it
      in_speed_run = true;
      pose = {briefing.start, Heading::up};
      continue;
    }
    pose.heading = turned(pose.heading, action.turn);
    Heading travel = action.advance < 0 ? opposite(pose.heading) : pose.heading;
    uint32_t wish = std::min<uint32_t>(std::abs(action.advance), briefing.longest_move);
    uint32_t cells = std::min(wish, maze.clear_cells(pose.cell, travel));
    if (cells < wish) played.bumps++;
    pose.cell = pose.cell.toward(travel, cells);
    if (!briefing.goal.contains(pose.cell)) continue;
    goal_seen = true;
    if (in_speed_run) {
      played.finished = true;
      break;
    }
  }
  return played;
}

// The journal, on this machine.

void wasmouse::log(Level level, const char *message) {
  std::cerr << unsigned(level) << ": " << message << '\n';
}

void wasmouse::paint(Cell, Color) {}
void wasmouse::label(Cell, const char *) {}
void wasmouse::believe(Cell, Heading, Wall) {}

void wasmouse::panic_at(const char *message, const char *file, int line) {
  std::cerr << message << " (" << file << ':' << line << ")\n";
  std::abort();
}
