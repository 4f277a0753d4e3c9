/**
 * What a robot and the host tell each other, as in `wit/robot.wit` of wasmouse.
 *
 * Distances (readings, `Move.advance`, `Briefing.longestMove`) are in units. All current rulesets
 * have 1 unit per cell, so a distance is a number of cells.
 */

/**
 * What the robot senses in its current position before it acts: in each direction relative to its
 * heading, how far it could drive before a wall stops it.
 *
 * 0 means a wall directly at that side. There is no rear sensor. Unit: units. In all current
 * rulesets the readings are exact and range from 0 to `briefing.dimension` - 1.
 */
export interface Sensors {
  /** Free distance to the left of the robot. */
  readonly left: number;
  /** Free distance ahead of the robot. */
  readonly front: number;
  /** Free distance to the right of the robot. */
  readonly right: number;
}

/**
 * A rotation on the spot, done before the robot moves.
 *
 * - `left`: A quarter turn counterclockwise (-90 degrees).
 * - `straight`: No rotation.
 * - `right`: A quarter turn clockwise (+90 degrees).
 */
export type Turn = "left" | "straight" | "right";

/** Turn first, then drive along the new heading. */
export interface Move {
  /** The rotation, done first. */
  readonly turn: Turn;
  /**
   * How far to drive after the rotation. Unit: units, from -128 to 127. Negative drives backwards
   * with the heading unchanged. The host clamps it to -`briefing.longest-move` ..=
   * `briefing.longest-move` and counts the clamp. At the first wall the robot stops and keeps the
   * distance it has covered, and the host counts a bump. Neither costs anything extra.
   */
  readonly advance: number;
}

/**
 * What the robot does in one step. Every action takes one step.
 *
 * - `move`: Turn, then drive. See {@link drive}.
 * - `reset`: End the exploration run and begin the speed run in the start cell, heading up. The
 *   reset itself is a step of the exploration run. It is ignored (the robot stays where it is and
 *   the step is spent) until a step of the exploration run has ended in the goal, and throughout
 *   the speed run. See {@link RESET}.
 */
export type Action = { readonly tag: "move"; readonly val: Move } | { readonly tag: "reset" };

/**
 * A cell of the maze. `x` grows to the right, `y` grows upward, and (0, 0) is the bottom left
 * corner.
 */
export interface Cell {
  /** Column, counted from the left, starting at 0. */
  readonly x: number;
  /** Row, counted from the bottom, starting at 0. */
  readonly y: number;
}

/** A rectangle of cells. */
export interface Area {
  /** The bottom left cell of the rectangle. */
  readonly origin: Cell;
  /** Unit: cells. */
  readonly width: number;
  /** Unit: cells. */
  readonly height: number;
}

/**
 * A direction in the maze, independent of the robot.
 *
 * - `up`: Towards larger `y`. The robot starts both runs with this heading.
 * - `right`: Towards larger `x`.
 * - `down`: Towards smaller `y`.
 * - `left`: Towards smaller `x`.
 */
export type Heading = "up" | "right" | "down" | "left";

/**
 * How `briefing.budget` applies to the two runs.
 *
 * - `both-runs`: The two runs share the budget.
 * - `each-run`: Each run has the whole budget for itself.
 */
export type BudgetScope = "both-runs" | "each-run";

/**
 * Everything a robot is told before its first step.
 *
 * A match has an exploration run and then a speed run. The speed run ends with the first step that
 * ends in a goal cell; passing through one does not count. The score is the number of steps in the
 * speed run plus the number of steps in the exploration run divided by `exploration-divisor`. Lower
 * is better.
 */
export interface Briefing {
  /**
   * The maze has `dimension` x `dimension` cells. Range: 2 to 64, or 0 if the track does not tell.
   * All current rulesets tell it; in contest mazes it is an even number from 12 to 20.
   */
  readonly dimension: number;
  /** The cell where both runs start. In contest mazes (0, 0). */
  readonly start: Cell;
  /**
   * The goal cells. In contest mazes the 2 x 2 room in the centre. A `width` and a `height` of 0
   * mean that the track does not tell; all current rulesets tell it.
   */
  readonly goal: Area;
  /**
   * How many steps the robot may take. Unit: steps. Range: 1 to 1,000,000; the ruleset `udacity`
   * sets 1,000. The step numbered `budget` is still executed.
   */
  readonly budget: number;
  /** Whether the two runs share `budget` or each has all of it. */
  readonly budgetScope: BudgetScope;
  /**
   * The longest move in one step, forwards or backwards. Unit: units. Range: 1 to 127. The ruleset
   * `udacity` sets 3.
   */
  readonly longestMove: number;
  /**
   * The distance from the centre of a cell to that of the next one. Unit: units. At least 1, and 1
   * in all current rulesets. A robot that assumes 1 should trap on any other value.
   */
  readonly unitsPerCell: number;
  /**
   * Steps of the exploration run are divided by this number in the score. Range: 1 to 1,000,000;
   * the ruleset `udacity` sets 30.
   */
  readonly explorationDivisor: number;
  /**
   * The robot's only source of randomness. The same seed in the same maze always gives the same
   * match. Range: 0 to 2n ** 64n - 1n. `Math.random` is seeded with it.
   */
  readonly seed: bigint;
  /**
   * Selects a variant of the robot. Each robot documents its own; the default is 0. A robot should
   * trap on a variant that it does not have.
   */
  readonly variant: number;
}

/** What a robot does in a match. */
export interface Robot {
  /** Called once per step with the readings at the robot's current position. */
  nextMove(sensors: Sensors): Action;
}

/** All four headings, clockwise from up. */
export const HEADINGS: readonly Heading[] = ["up", "right", "down", "left"];
const TURNS: readonly (Turn | null)[] = ["straight", "right", null, "left"];
const NUMBERS = { up: 0, right: 1, down: 2, left: 3 };
const QUARTERS = { left: 3, straight: 0, right: 1 };

/** The place of a heading in {@link HEADINGS}. */
export function headingNumber(heading: Heading): number {
  return NUMBERS[heading];
}

/** The heading after a turn on the spot. */
export function turned(heading: Heading, turn: Turn): Heading {
  return HEADINGS[(NUMBERS[heading] + QUARTERS[turn]) & 3]!;
}

/** The opposite heading. */
export function opposite(heading: Heading): Heading {
  return HEADINGS[(NUMBERS[heading] + 2) & 3]!;
}

/**
 * The turn from a heading to another; `null` if that is behind the robot, because one step cannot
 * turn that far.
 */
export function turnTo(heading: Heading, target: Heading): Turn | null {
  return TURNS[(NUMBERS[target] + 4 - NUMBERS[heading]) & 3]!;
}

/**
 * The cell `distance` cells away in that direction, ignoring walls and the size of the maze.
 */
export function toward({ x, y }: Cell, heading: Heading, distance: number): Cell {
  switch (heading) {
    case "up":
      return { x, y: y + distance };
    case "right":
      return { x: x + distance, y };
    case "down":
      return { x, y: y - distance };
    case "left":
      return { x: x - distance, y };
  }
}

/** Whether `cell` lies in the rectangle. */
export function contains({ origin, width, height }: Area, { x, y }: Cell): boolean {
  return x >= origin.x && y >= origin.y && x < origin.x + width && y < origin.y + height;
}

/** All cells, column by column from the left, each from the bottom up. */
export function cells({ origin, width, height }: Area): Cell[] {
  const all: Cell[] = [];
  for (let dx = 0; dx < width; dx++) {
    for (let dy = 0; dy < height; dy++) all.push({ x: origin.x + dx, y: origin.y + dy });
  }
  return all;
}

/**
 * The goal room of a contest maze: the 2 x 2 cells in the centre, or the single centre cell if
 * `dimension` is odd.
 */
export function center(dimension: number): Area {
  const low = Math.floor((dimension - 1) / 2);
  const side = dimension % 2 === 0 ? 2 : 1;
  return { origin: { x: low, y: low }, width: side, height: side };
}

/** Turns, then drives `advance` cells along the new heading; backwards when it is negative. */
export function drive(turn: Turn, advance: number): Action {
  return { tag: "move", val: { turn, advance } };
}

/** Ends the exploration run. */
export const RESET: Action = { tag: "reset" };

/** The briefing of the ruleset `udacity` for a contest maze of this size, for tests. */
export function contestBriefing(dimension: number): Briefing {
  return {
    dimension,
    start: { x: 0, y: 0 },
    goal: center(dimension),
    budget: 1000,
    budgetScope: "both-runs",
    longestMove: 3,
    unitsPerCell: 1,
    explorationDivisor: 30,
    seed: 0n,
    variant: 0,
  };
}
