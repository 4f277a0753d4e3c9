/** What a robot knows about the walls. */
import type { Cell, Heading, Sensors } from "./interface.js";
import type { Pose } from "./pose.js";
/** What is known about one wall. */
export type Wall = "unknown" | "open" | "closed";
/**
 * How to treat unknown walls.
 *
 * - `optimistic`: Unknown walls count as open: for exploring.
 * - `pessimistic`: Unknown walls count as closed: for driving only where it is certain.
 */
export type View = "optimistic" | "pessimistic";
/** What was new in a reading. */
export interface News {
  /** Walls that were not known to be open before. */
  opened: number;
  /** Walls that were not known to be closed before. */
  closed: number;
}
/** Which walls of a square maze may be driven through. The perimeter never may. */
export declare class Passages {
  readonly dimension: number;
  /** By (row * dimension + column) * 4 + heading: 1 where there is an opening. */
  readonly open: Uint8Array;
  /** Every wall stands. The dimension is from 2 to 64. */
  constructor(dimension: number);
  /** Only the perimeter stands. */
  static allOpen(dimension: number): Passages;
  /** Whether the maze has that cell. */
  contains({ x, y }: Cell): boolean;
  /** Where the cell is in arrays with a place for every cell. */
  place({ x, y }: Cell): number;
  /**
   * Whether the wall on that side of `cell` may be driven through; `false` outside the maze.
   */
  isOpen(cell: Cell, heading: Heading): boolean;
  /**
   * Opens or closes the wall on that side of `cell`, for both its cells; walls of the perimeter
   * stay closed.
   */
  set(cell: Cell, heading: Heading, open: boolean): void;
  /** How many cells in a row can be driven from `cell` in that direction, at most `longest`. */
  clearCells(cell: Cell, heading: Heading, longest: number): number;
}
/**
 * The walls of a square maze, each unknown, open or closed.
 *
 * At first the perimeter is closed and everything else is unknown. (`Map` is JavaScript's own.)
 */
export declare class MazeMap {
  readonly dimension: number;
  /** The walls known to be open. */
  readonly known: Passages;
  /** The walls not known to be closed. */
  readonly possible: Passages;
  /** The dimension is the number of cells along each side, from 2 to 64. */
  constructor(dimension: number);
  /** Whether the maze has that cell. */
  contains(cell: Cell): boolean;
  /**
   * What is known about the wall on that side of `cell`. The perimeter and everything beyond it is
   * closed.
   */
  wall(cell: Cell, heading: Heading): Wall;
  /** Overrides what is known about a wall; the perimeter stays closed. */
  set(cell: Cell, heading: Heading, wall: Wall): void;
  /** The walls that may be driven through in that view. */
  passages(view: View): Passages;
  /**
   * Adds a reading made at `pose`: in each of the three directions that many open walls and then a
   * closed one. A reading that ends outside the maze ends at its perimeter.
   */
  observe({ cell, heading }: Pose, sensors: Sensors): News;
  private look;
}
