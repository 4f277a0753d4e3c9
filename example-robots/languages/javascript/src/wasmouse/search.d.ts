/**
 * The flood: the fewest steps from every cell to a set of cells.
 *
 * A breadth-first search over steps: one step drives up to the longest move in a straight line, in
 * any of the four directions (including backwards, so the heading does not matter).
 */
import type { Cell } from "./interface.js";
import type { Passages } from "./map.js";
import type { Hop, Pose } from "./pose.js";
/** Distances in steps to a set of cells. */
export declare class Search {
  private readonly dimension;
  private readonly longestMove;
  /** Steps by row * dimension + column; -1 where the last search did not arrive. */
  private readonly distances;
  /** What a step of one cell adds to a place, by heading. */
  private readonly strides;
  constructor(dimension: number, longestMove: number);
  /** Computes the distance of every cell to the nearest of `targets`. */
  fill(passages: Passages, targets: readonly Cell[]): void;
  /**
   * Like `fill`, but stops when the distance of `from` is known. All cells at most as far are known
   * then; the others count as not reached.
   */
  fillUntil(passages: Passages, targets: readonly Cell[], from: Cell): void;
  private search;
  /** Steps from `cell` to the nearest target; `null` when the last search did not reach it. */
  steps({ x, y }: Cell): number | null;
  /**
   * A shortest route to a target for a robot in this pose, hop by hop; empty if there is none or
   * the robot is in a target.
   *
   * Between routes of equal length it prefers to drive straight, then right, left, backwards; then
   * longer hops to shorter ones. `passages` are those of the last search, or fewer.
   */
  route(passages: Passages, pose: Pose): Generator<Hop>;
  /** The first hop of `route`, or `null`. */
  nextHop(passages: Passages, pose: Pose): Hop | null;
  /**
   * The first hop of `route`, provided that the whole route still leads to a target.
   *
   * Closing walls makes no route shorter. So as long as `passages` are those of the last search
   * with more walls closed, a route that is still open is still a shortest one, and there is no
   * need to search again. `null` means that a new search is needed, or that there is no route.
   */
  firstHop(passages: Passages, pose: Pose): Hop | null;
  private preferredHop;
  /** The longest drive in that direction that ends `goal` steps from a target. */
  private longestHop;
}
