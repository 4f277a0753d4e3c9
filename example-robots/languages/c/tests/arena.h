// A match by the rules of the contest, on this machine.
#ifndef ARENA_H
#define ARENA_H

#include "wasmouse/robot.h"

typedef struct {
  bool finished;
  uint32_t exploration_steps, speed_steps;
  uint32_t bumps; // moves that a wall cut short
} Played;

// Plays the robot in a maze file in the Udacity format.
Played play(const char *maze_file);

#endif
