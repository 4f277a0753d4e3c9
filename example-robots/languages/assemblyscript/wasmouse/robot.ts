// What the host gives and takes.

import { Area, Cell, Turn, cellAt } from "./geometry";

/** Everything that a robot is told before its first step. */
export class Briefing {
  /** The maze has `dimension` x `dimension` cells: 2 to 64. */
  dimension: i32 = 0;
  /** Where both runs start. */
  start: Cell = cellAt(0, 0);
  /** In contest mazes the 2 x 2 room in the centre. */
  goal: Area = new Area(0, 0, 0, 0);
  /** How many steps the robot may take. */
  budget: i32 = 0;
  /** Whether each run has the whole budget for itself. */
  budgetIsEachRun: bool = false;
  /** The longest move in one step, in cells. */
  longestMove: i32 = 0;
  /** 1 in all current rulesets. */
  unitsPerCell: i32 = 0;
  /** Divides the steps of the exploration run in the score. */
  explorationDivisor: i32 = 0;
  /** The only source of randomness. */
  seed: u64 = 0;
  /** Selects a variant of the robot. */
  variant: i32 = 0;
}

/**
 * What the robot does in one step, as the host takes it: the address of three bytes in memory,
 * which are its kind, the turn and the advance.
 */
export type Action = usize;

const answer = new StaticArray<u8>(3);

/** Turn, then drive that many cells; negative drives backwards. */
export function move(turn: Turn, advance: i32): Action {
  answer[0] = 0;
  answer[1] = turn as u8;
  answer[2] = advance as u8;
  return changetype<usize>(answer);
}

/** Begin the speed run in the start cell. */
export function reset(): Action {
  answer[0] = 1;
  return changetype<usize>(answer);
}
