// A match by the rules of the contest, on this machine.
#pragma once

#include <string>

#include "wasmouse/robot.hpp"

struct Played {
  bool finished = false;
  uint32_t exploration_steps = 0, speed_steps = 0;
  uint32_t bumps = 0; // moves that a wall cut short
};

// Plays the robot in a maze file in the Udacity format.
Played play(const std::string &maze_file);
