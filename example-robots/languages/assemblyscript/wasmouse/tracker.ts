// The robot's position, the walls that it has seen, and the run that it is in.

import { Cell, Heading, Turn, opposite, toward, turned } from "./geometry";
import { Map, View } from "./map";
import { Action, Briefing, move, reset } from "./robot";

export enum Run { Exploration, Speed }

/**
 * Stays correct as long as the robot returns only actions from `go`, `turn` and `reset`. Moves are
 * limited to what is known to be open, so the robot never bumps.
 */
export class Tracker {
  cell: Cell;
  heading: Heading = Heading.Up;
  run: Run = Run.Exploration;
  /** How many steps are left of the current budget, including this one. */
  stepsLeft: i32;
  readonly map: Map;
  /** A step of the exploration run has ended in the goal. */
  private goalSeen: bool = false;

  constructor(readonly briefing: Briefing) {
    this.cell = briefing.start;
    this.stepsLeft = briefing.budget;
    this.map = new Map(briefing.dimension);
  }

  /** Adds the readings of this step to the map. Returns how many closed walls are new. */
  observe(left: i32, front: i32, right: i32): i32 {
    return this.map.observe(this.cell, this.heading, left, front, right);
  }

  /**
   * The action that drives up to `cells` cells in that direction of the maze, limited to cells known
   * to be reachable and to the longest move. It drives backwards if the direction is behind the
   * robot; if the nearest wall there is unknown, it turns right on the spot to see it.
   */
  go(heading: Heading, cells: i32): Action {
    cells = min(cells, this.briefing.longestMove);
    const clear = this.map.clearCells(View.Pessimistic, this.cell, heading, cells);
    if (heading == opposite(this.heading)) {
      if (clear == 0 && cells > 0 && this.map.isOpen(View.Optimistic, this.cell, heading)) {
        return this.answer(Turn.Right, heading, 0);
      }
      return this.answer(Turn.Straight, heading, -clear);
    }
    let turn = Turn.Straight;
    if (heading == turned(this.heading, Turn.Left)) turn = Turn.Left;
    if (heading == turned(this.heading, Turn.Right)) turn = Turn.Right;
    return this.answer(turn, heading, clear);
  }

  /** The action that only turns. */
  turn(turn: Turn): Action {
    return this.answer(turn, this.heading, 0);
  }

  /** The reset, which begins the speed run in the start cell. */
  reset(): Action {
    this.stepsLeft = max(this.stepsLeft - 1, 0);
    if (this.mayReset()) {
      this.run = Run.Speed;
      this.cell = this.briefing.start;
      this.heading = Heading.Up;
      if (this.briefing.budgetIsEachRun) this.stepsLeft = this.briefing.budget;
    }
    return reset();
  }

  /** Whether the host accepts a reset: in the exploration run, after a step has ended in the goal. */
  mayReset(): bool {
    return this.run == Run.Exploration && this.goalSeen;
  }

  private answer(turn: Turn, travel: Heading, advance: i32): Action {
    this.cell = toward(this.cell, travel, abs(advance));
    this.heading = turned(this.heading, turn);
    this.stepsLeft = max(this.stepsLeft - 1, 0);
    if (this.briefing.goal.contains(this.cell)) this.goalSeen = true;
    return move(turn, advance);
  }
}
