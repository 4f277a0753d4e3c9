/** The state of a match as a robot knows it. It decides nothing. */

import { contains, drive, RESET, turnTo } from "./interface.js";
import { MazeMap } from "./map.js";
import { atStart, moved } from "./pose.js";

/**
 * The robot's position, the walls that it has seen, and the steps that are left.
 *
 * In each step, pass the readings to `observe` and return the action from `go`, `turn` or `reset`.
 * Moves are limited to what is known to be open, so the robot never bumps and always knows its
 * position.
 */
export class Tracker {
  constructor(briefing) {
    this.briefing = briefing;
    this.map = new MazeMap(briefing.dimension);
    if (!this.map.contains(briefing.start)) throw new RangeError("the start is outside the maze");
    this.pose = atStart(briefing.start);
    this.run = "exploration";
    /** How many steps are left, including this one. If each run has its own budget, of this run. */
    this.stepsLeft = briefing.budget;
    this.goalSeen = false;
  }

  /** The robot's cell. */
  get cell() {
    return this.pose.cell;
  }

  /** Adds the readings of this step to the map. */
  observe(sensors) {
    return this.map.observe(this.pose, sensors);
  }

  /**
   * The action that drives up to `cells` cells in that direction of the maze, limited to cells
   * known to be reachable and to the longest move.
   *
   * It turns if the direction is to a side, and drives backwards if it is behind the robot. There
   * is no rear sensor: if the nearest wall behind is unknown, the action turns right on the spot
   * instead, to see it in the next step.
   */
  go(heading, cells) {
    cells = Math.min(cells, this.briefing.longestMove);
    const clear = this.map.known.clearCells(this.cell, heading, cells);
    const turn = turnTo(this.pose.heading, heading);
    if (turn !== null) return this.answer(turn, heading, clear);
    if (clear === 0 && cells > 0 && this.map.possible.isOpen(this.cell, heading)) {
      return this.answer("right", heading, 0);
    }
    return this.answer("straight", heading, -clear);
  }

  /** The action that only turns. */
  turn(turn) {
    return this.answer(turn, this.pose.heading, 0);
  }

  /**
   * The reset, which begins the speed run in the start cell. Where the host ignores it (see
   * `mayReset`) the position stays and the step is spent.
   */
  reset() {
    this.stepsLeft = Math.max(this.stepsLeft - 1, 0);
    if (this.mayReset()) {
      this.run = "speed";
      this.pose = atStart(this.briefing.start);
      if (this.briefing.budgetScope === "each-run") this.stepsLeft = this.briefing.budget;
    }
    return RESET;
  }

  /**
   * Whether the host accepts a reset: in the exploration run, after a step has ended in the goal.
   */
  mayReset() {
    return this.run === "exploration" && this.goalSeen;
  }

  /** Whether the robot is in the goal. */
  inGoal() {
    return contains(this.briefing.goal, this.cell);
  }

  answer(turn, travel, advance) {
    this.pose = moved(this.pose, turn, travel, Math.abs(advance));
    this.stepsLeft = Math.max(this.stepsLeft - 1, 0);
    this.goalSeen ||= this.inGoal();
    // Not -0, which is no whole number to every engine.
    return drive(turn, advance + 0);
  }
}
