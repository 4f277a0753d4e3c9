#include <stdio.h>
#include <stdlib.h>

#include "tests/arena.h"

static uint32_t dimension;
// By x and y: a bit for each heading without a wall.
static unsigned open[DIMENSION_MAX][DIMENSION_MAX];

static void read_maze(const char *name) {
  FILE *file = fopen(name, "r");
  bool is_read = file != NULL && fscanf(file, "%u", &dimension) == 1 && dimension <= DIMENSION_MAX;
  for (uint32_t x = 0; is_read && x < dimension; x++)
    for (uint32_t y = 0; is_read && y < dimension; y++)
      is_read = fscanf(file, y == 0 ? "%u" : ",%u", &open[x][y]) == 1;
  if (!is_read) {
    fprintf(stderr, "cannot read the maze %s\n", name);
    exit(1);
  }
  fclose(file);
}

static uint32_t clear_cells(Cell cell, Heading heading) {
  uint32_t cells = 0;
  for (; open[cell.x][cell.y] >> heading & 1; cells++) cell = cell_toward(cell, heading, 1);
  return cells;
}

Played play(const char *maze_file) {
  read_maze(maze_file);
  Briefing briefing = {
      .dimension = dimension,
      .goal = {{dimension / 2 - 1, dimension / 2 - 1}, 2, 2},
      .budget = 1000,
      .longest_move = 3,
      .units_per_cell = 1,
      .exploration_divisor = 30,
  };
  Played played = {0};
  Pose pose = {briefing.start, HEADING_UP};
  bool goal_seen = false, in_speed_run = false;
  robot_start(&briefing);
  for (uint32_t step = 0; step < briefing.budget; step++) {
    Action action = robot_next_move((Sensors){
        clear_cells(pose.cell, heading_turned(pose.heading, TURN_LEFT)),
        clear_cells(pose.cell, pose.heading),
        clear_cells(pose.cell, heading_turned(pose.heading, TURN_RIGHT)),
    });
    ++*(in_speed_run ? &played.speed_steps : &played.exploration_steps);
    if (action.kind == ACTION_RESET) {
      if (!goal_seen || in_speed_run) continue; // the host ignores it
      in_speed_run = true;
      pose = (Pose){briefing.start, HEADING_UP};
      continue;
    }
    pose.heading = heading_turned(pose.heading, action.turn);
    Heading travel = action.advance < 0 ? heading_opposite(pose.heading) : pose.heading;
    uint32_t wish = (uint32_t)abs(action.advance), clear = clear_cells(pose.cell, travel);
    if (wish > briefing.longest_move) wish = briefing.longest_move;
    if (wish > clear) {
      wish = clear;
      played.bumps++;
    }
    pose.cell = cell_toward(pose.cell, travel, wish);
    if (!area_contains(briefing.goal, pose.cell)) continue;
    goal_seen = true;
    if (in_speed_run) {
      played.finished = true;
      break;
    }
  }
  return played;
}

// The journal, on this machine.

void journal_log(Level level, const char *message) {
  fprintf(stderr, "%d: %s\n", (int)level, message);
}

void journal_paint(Cell cell, Color color) {
  (void)cell, (void)color;
}

void journal_label(Cell cell, const char *text) {
  (void)cell, (void)text;
}

void journal_wall(Cell cell, Heading side, Wall belief) {
  (void)cell, (void)side, (void)belief;
}

_Noreturn void robot_panic_at(const char *message, const char *file, int line) {
  fprintf(stderr, "%s (%s:%d)\n", message, file, line);
  abort();
}
