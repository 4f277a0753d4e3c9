/**
 * The flood: the fewest steps from every cell to a set of cells.
 *
 * A breadth-first search over steps: one step drives up to the longest move in a straight line, in
 * any of the four directions (including backwards, so the heading does not matter).
 */

import { headingNumber, opposite, turned } from "./interface";
import type { Cell, Heading } from "./interface";
import type { Passages } from "./map";
import { hopped } from "./pose";
import type { Hop, Pose } from "./pose";

/** Distances in steps to a set of cells. */
export class Search {
  /** Steps by row * dimension + column; -1 where the last search did not arrive. */
  private readonly distances: Int16Array;
  /** What a step of one cell adds to a place, by heading. */
  private readonly strides: readonly number[];

  constructor(
    private readonly dimension: number,
    private readonly longestMove: number,
  ) {
    this.distances = new Int16Array(dimension * dimension).fill(-1);
    this.strides = [dimension, 1, -dimension, -1];
  }

  /** Computes the distance of every cell to the nearest of `targets`. */
  fill(passages: Passages, targets: readonly Cell[]): void {
    this.search(passages, targets, -1);
  }

  /**
   * Like `fill`, but stops when the distance of `from` is known. All cells at most as far are known
   * then; the others count as not reached.
   */
  fillUntil(passages: Passages, targets: readonly Cell[], from: Cell): void {
    this.search(passages, targets, passages.place(from));
  }

  private search(passages: Passages, targets: readonly Cell[], stop: number): void {
    const { distances, strides, longestMove } = this;
    const open = passages.open;
    distances.fill(-1);
    let frontier: number[] = [];
    for (const target of targets) {
      const place = passages.place(target);
      if (distances[place] === -1) frontier.push(place);
      distances[place] = 0;
    }
    for (let steps = 1; frontier.length > 0 && !(stop >= 0 && distances[stop]! >= 0); steps++) {
      const next: number[] = [];
      for (const place of frontier) {
        for (let heading = 0; heading < 4; heading++) {
          const stride = strides[heading]!;
          let at = place;
          // The perimeter is closed, so no place is outside.
          for (let cells = 0; cells < longestMove && open[at * 4 + heading] === 1; cells++) {
            at += stride;
            if (distances[at] === -1) {
              distances[at] = steps;
              next.push(at);
            }
          }
        }
      }
      frontier = next;
    }
  }

  /** Steps from `cell` to the nearest target; `null` when the last search did not reach it. */
  steps({ x, y }: Cell): number | null {
    if (!(x >= 0 && y >= 0 && x < this.dimension && y < this.dimension)) return null;
    const steps = this.distances[y * this.dimension + x]!;
    return steps < 0 ? null : steps;
  }

  /**
   * A shortest route to a target for a robot in this pose, hop by hop; empty if there is none or
   * the robot is in a target.
   *
   * Between routes of equal length it prefers to drive straight, then right, left, backwards; then
   * longer hops to shorter ones. `passages` are those of the last search, or fewer.
   */
  *route(passages: Passages, pose: Pose): Generator<Hop> {
    for (let steps = this.steps(pose.cell); steps !== null && steps > 0; steps--) {
      const hop = this.preferredHop(passages, pose, steps - 1);
      if (hop === null) return;
      yield hop;
      pose = hopped(pose, hop);
    }
  }

  /** The first hop of `route`, or `null`. */
  nextHop(passages: Passages, pose: Pose): Hop | null {
    const steps = this.steps(pose.cell);
    return steps === null || steps === 0 ? null : this.preferredHop(passages, pose, steps - 1);
  }

  /**
   * The first hop of `route`, provided that the whole route still leads to a target.
   *
   * Closing walls makes no route shorter. So as long as `passages` are those of the last search
   * with more walls closed, a route that is still open is still a shortest one, and there is no
   * need to search again. `null` means that a new search is needed, or that there is no route.
   */
  firstHop(passages: Passages, pose: Pose): Hop | null {
    const route = [...this.route(passages, pose)];
    return route.length > 0 && route.length === this.steps(pose.cell) ? route[0]! : null;
  }

  private preferredHop(passages: Passages, { cell, heading }: Pose, goal: number): Hop | null {
    const order = [
      heading,
      turned(heading, "right"),
      turned(heading, "left"),
      opposite(heading),
    ];
    for (const heading of order) {
      const cells = this.longestHop(passages, cell, heading, goal);
      if (cells > 0) return { heading, cells };
    }
    return null;
  }

  /** The longest drive in that direction that ends `goal` steps from a target. */
  private longestHop(passages: Passages, cell: Cell, heading: Heading, goal: number): number {
    const side = headingNumber(heading);
    const stride = this.strides[side]!;
    let at = passages.place(cell);
    let longest = 0;
    for (let cells = 1; cells <= this.longestMove && passages.open[at * 4 + side] === 1; cells++) {
      at += stride;
      if (this.distances[at] === goal) longest = cells;
    }
    return longest;
  }
}
