/** What a robot knows about the walls. */

import { HEADINGS, headingNumber, toward, turned } from "./interface";
import type { Cell, Heading, Sensors } from "./interface";
import type { Pose } from "./pose";

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
export class Passages {
  /** By (row * dimension + column) * 4 + heading: 1 where there is an opening. */
  readonly open: Uint8Array;

  /** Every wall stands. The dimension is from 2 to 64. */
  constructor(readonly dimension: number) {
    if (!(dimension >= 2 && dimension <= 64)) {
      throw new RangeError(`the dimension is ${dimension} and not from 2 to 64`);
    }
    this.open = new Uint8Array(dimension * dimension * 4);
  }

  /** Only the perimeter stands. */
  static allOpen(dimension: number): Passages {
    const passages = new Passages(dimension);
    for (let x = 0; x < dimension; x++) {
      for (let y = 0; y < dimension; y++) {
        for (const heading of HEADINGS) passages.set({ x, y }, heading, true);
      }
    }
    return passages;
  }

  /** Whether the maze has that cell. */
  contains({ x, y }: Cell): boolean {
    return x >= 0 && y >= 0 && x < this.dimension && y < this.dimension;
  }

  /** Where the cell is in arrays with a place for every cell. */
  place({ x, y }: Cell): number {
    return y * this.dimension + x;
  }

  /**
   * Whether the wall on that side of `cell` may be driven through; `false` outside the maze.
   */
  isOpen(cell: Cell, heading: Heading): boolean {
    return this.contains(cell) && this.open[this.place(cell) * 4 + headingNumber(heading)] === 1;
  }

  /**
   * Opens or closes the wall on that side of `cell`, for both its cells; walls of the perimeter
   * stay closed.
   */
  set(cell: Cell, heading: Heading, open: boolean): void {
    const other = toward(cell, heading, 1);
    if (!this.contains(cell) || !this.contains(other)) return;
    const side = headingNumber(heading);
    this.open[this.place(cell) * 4 + side] = open ? 1 : 0;
    this.open[this.place(other) * 4 + ((side + 2) & 3)] = open ? 1 : 0;
  }

  /** How many cells in a row can be driven from `cell` in that direction, at most `longest`. */
  clearCells(cell: Cell, heading: Heading, longest: number): number {
    let count = 0;
    while (count < longest && this.isOpen(cell, heading)) {
      cell = toward(cell, heading, 1);
      count++;
    }
    return count;
  }
}

/**
 * The walls of a square maze, each unknown, open or closed.
 *
 * At first the perimeter is closed and everything else is unknown. (`Map` is JavaScript's own.)
 */
export class MazeMap {
  /** The walls known to be open. */
  readonly known: Passages;
  /** The walls not known to be closed. */
  readonly possible: Passages;

  /** The dimension is the number of cells along each side, from 2 to 64. */
  constructor(readonly dimension: number) {
    this.known = new Passages(dimension);
    this.possible = Passages.allOpen(dimension);
  }

  /** Whether the maze has that cell. */
  contains(cell: Cell): boolean {
    return this.known.contains(cell);
  }

  /**
   * What is known about the wall on that side of `cell`. The perimeter and everything beyond it is
   * closed.
   */
  wall(cell: Cell, heading: Heading): Wall {
    if (!this.possible.isOpen(cell, heading)) return "closed";
    return this.known.isOpen(cell, heading) ? "open" : "unknown";
  }

  /** Overrides what is known about a wall; the perimeter stays closed. */
  set(cell: Cell, heading: Heading, wall: Wall): void {
    this.known.set(cell, heading, wall === "open");
    this.possible.set(cell, heading, wall !== "closed");
  }

  /** The walls that may be driven through in that view. */
  passages(view: View): Passages {
    return view === "optimistic" ? this.possible : this.known;
  }

  /**
   * Adds a reading made at `pose`: in each of the three directions that many open walls and then a
   * closed one. A reading that ends outside the maze ends at its perimeter.
   */
  observe({ cell, heading }: Pose, sensors: Sensors): News {
    const news = { opened: 0, closed: 0 };
    this.look(cell, turned(heading, "left"), sensors.left, news);
    this.look(cell, heading, sensors.front, news);
    this.look(cell, turned(heading, "right"), sensors.right, news);
    return news;
  }

  private look(cell: Cell, heading: Heading, reading: number, news: News): void {
    for (let count = 0; count < reading; count++) {
      const there = toward(cell, heading, 1);
      if (!this.contains(there)) break;
      if (!this.known.isOpen(cell, heading)) {
        news.opened++;
        this.set(cell, heading, "open");
      }
      cell = there;
    }
    if (this.possible.isOpen(cell, heading)) {
      news.closed++;
      this.set(cell, heading, "closed");
    }
  }
}
