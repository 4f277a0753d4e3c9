// The fewest steps from every cell to a goal. One step drives up to the longest move in a straight
// line, in any direction, so the heading does not matter.

import {
  Area, Cell, DIMENSION_MAX, Heading, Turn, cellAt, opposite, toward, turned,
} from "./geometry";
import { Map, View } from "./map";

/** What `steps` gives for cells that the last search did not reach. */
export const NOT_REACHED: u16 = 0xFFFF;

/** A drive in a direction of the maze. */
export class Hop {
  constructor(readonly heading: Heading, readonly cells: i32) {}

  /** The cell where it ends. */
  cellAfter(cell: Cell): Cell {
    return toward(cell, this.heading, this.cells);
  }

  /**
   * The heading after it. The robot turns to the hop's heading, unless that is behind it; then it
   * drives backwards.
   */
  headingAfter(heading: Heading): Heading {
    return this.heading == opposite(heading) ? heading : this.heading;
  }
}

/** The distances of the last search. */
export class Search {
  private distances: StaticArray<u16> = new StaticArray<u16>(DIMENSION_MAX * DIMENSION_MAX);
  private queue: StaticArray<Cell> = new StaticArray<Cell>(DIMENSION_MAX * DIMENSION_MAX);

  /** Nothing is reached yet. */
  constructor(readonly longestMove: i32) {
    this.distances.fill(NOT_REACHED);
  }

  steps(cell: Cell): u16 {
    return this.distances[cell];
  }

  /**
   * Computes the distance of every cell to the goal, until that of `from` is known: all cells at
   * most as far as `from` are known then, and the others count as not reached.
   */
  fillUntil(map: Map, view: View, goal: Area, from: Cell): void {
    let head = 0, tail = 0;
    this.distances.fill(NOT_REACHED);
    for (let x = 0; x < goal.width; x++) {
      for (let y = 0; y < goal.height; y++) {
        const cell = cellAt(goal.x + x, goal.y + y);
        this.distances[cell] = 0;
        this.queue[tail++] = cell;
      }
    }
    while (head < tail) {
      const cell = this.queue[head++];
      const steps = this.distances[cell];
      if (steps >= this.distances[from]) return; // everything as far as `from` is known
      for (let heading = Heading.Up; heading <= Heading.Left; heading++) {
        let there = cell;
        for (let cells = 0; cells < this.longestMove; cells++) {
          if (!map.isOpen(view, there, heading)) break;
          there = toward(there, heading, 1);
          if (this.distances[there] == NOT_REACHED) {
            this.distances[there] = steps + 1;
            this.queue[tail++] = there;
          }
        }
      }
    }
  }

  /**
   * The next hop of a shortest route; null if the last search knows none, or in the goal. Between
   * routes of equal length it prefers to drive straight, then right, left, backwards; then longer
   * hops to shorter ones.
   */
  nextHop(map: Map, view: View, cell: Cell, heading: Heading): Hop | null {
    const steps = this.distances[cell];
    if (steps == 0 || steps == NOT_REACHED) return null;
    return this.hopToward(map, view, cell, heading, steps - 1)
      || this.hopToward(map, view, cell, turned(heading, Turn.Right), steps - 1)
      || this.hopToward(map, view, cell, turned(heading, Turn.Left), steps - 1)
      || this.hopToward(map, view, cell, opposite(heading), steps - 1);
  }

  /**
   * The same, provided that the whole route still leads to the goal. Walls that close make no route
   * shorter, so as long as none opens, such a route is still a shortest one, and there is no need
   * to search again.
   */
  firstHop(map: Map, view: View, cell: Cell, heading: Heading): Hop | null {
    const first = this.nextHop(map, view, cell, heading);
    let hop = first;
    while (hop) {
      heading = hop.headingAfter(heading);
      cell = hop.cellAfter(cell);
      hop = this.nextHop(map, view, cell, heading);
    }
    return this.distances[cell] == 0 ? first : null;
  }

  /** The longest drive in that direction that ends `goal` steps from the goal. */
  private hopToward(map: Map, view: View, cell: Cell, heading: Heading, goal: u16): Hop | null {
    let longest = 0;
    for (let cells = 1; cells <= this.longestMove; cells++) {
      if (!map.isOpen(view, cell, heading)) break;
      cell = toward(cell, heading, 1);
      if (this.distances[cell] == goal) longest = cells;
    }
    return longest > 0 ? new Hop(heading, longest) : null;
  }
}
