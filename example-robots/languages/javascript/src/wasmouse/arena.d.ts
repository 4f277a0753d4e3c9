/**
 * Matches for a robot's tests, without WebAssembly and without the host.
 *
 * A small, independent implementation of the contest rules. It has no fuel and no limits.
 */
import type { Action, Briefing, Cell, Heading, Robot } from "./interface.js";
/** The outcome of a match. */
export interface Played {
  /** Whether the speed run ended in the goal. */
  finished: boolean;
  /** Whether a step of the exploration run ended in the goal. */
  goalSeen: boolean;
  /** Steps of the exploration run, including the reset. */
  explorationSteps: number;
  /** Steps of the speed run. */
  speedSteps: number;
  /** Moves stopped by a wall. */
  bumps: number;
  /** Every action, in order. */
  actions: Action[];
}
/** The outcome in one line, such as `finished 31 + 21: 22.033`. */
export declare function summary(played: Played): string;
/**
 * A maze by columns from the left, each from the bottom up. A cell is the sum of its open sides:
 * 1 up, 2 right, 4 down, 8 left.
 */
export declare class Maze {
  readonly columns: readonly (readonly number[])[];
  readonly dimension: number;
  constructor(columns: readonly (readonly number[])[]);
  /** Reads the text format of the contest: the dimension, then a line per column. */
  static parse(text: string): Maze;
  /** Whether there is no wall on that side of `cell`. */
  isOpen({ x, y }: Cell, heading: Heading): boolean;
  /** How many cells are free in that direction. */
  sight(cell: Cell, heading: Heading): number;
}
/** A test maze of the contest, 12 x 12. The fewest steps of a speed run are 17. */
export declare const MAZE_01: Maze;
/** Plays one match by the rules of the ruleset `udacity`. */
export declare function play(start: (briefing: Briefing) => Robot, maze: Maze, briefing?: Briefing): Played;
