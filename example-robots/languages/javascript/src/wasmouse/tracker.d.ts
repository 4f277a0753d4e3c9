/** The state of a match as a robot knows it. It decides nothing. */
import type { Action, Briefing, Cell, Heading, Sensors, Turn } from "./interface.js";
import { MazeMap } from "./map.js";
import type { News } from "./map.js";
import type { Pose } from "./pose.js";
/**
 * One of the two runs of a match.
 *
 * - `exploration`: find the goal, learn the maze, reset.
 * - `speed`: to the goal in as few steps as possible.
 */
export type Run = "exploration" | "speed";
/**
 * The robot's position, the walls that it has seen, and the steps that are left.
 *
 * In each step, pass the readings to `observe` and return the action from `go`, `turn` or `reset`.
 * Moves are limited to what is known to be open, so the robot never bumps and always knows its
 * position.
 */
export declare class Tracker {
  readonly briefing: Briefing;
  readonly map: MazeMap;
  pose: Pose;
  run: Run;
  /** How many steps are left, including this one. If each run has its own budget, of this run. */
  stepsLeft: number;
  private goalSeen;
  constructor(briefing: Briefing);
  /** The robot's cell. */
  get cell(): Cell;
  /** Adds the readings of this step to the map. */
  observe(sensors: Sensors): News;
  /**
   * The action that drives up to `cells` cells in that direction of the maze, limited to cells
   * known to be reachable and to the longest move.
   *
   * It turns if the direction is to a side, and drives backwards if it is behind the robot. There
   * is no rear sensor: if the nearest wall behind is unknown, the action turns right on the spot
   * instead, to see it in the next step.
   */
  go(heading: Heading, cells: number): Action;
  /** The action that only turns. */
  turn(turn: Turn): Action;
  /**
   * The reset, which begins the speed run in the start cell. Where the host ignores it (see
   * `mayReset`) the position stays and the step is spent.
   */
  reset(): Action;
  /**
   * Whether the host accepts a reset: in the exploration run, after a step has ended in the goal.
   */
  mayReset(): boolean;
  /** Whether the robot is in the goal. */
  inGoal(): boolean;
  private answer;
}
