// What a robot knows about the walls.

import {
  Cell, DIMENSION_MAX, Heading, Turn, cellAt, columnOf, opposite, rowOf, toward, turned,
} from "./geometry";

export enum Wall { Unknown, Open, Closed }

/** How to treat unknown walls. */
export enum View {
  /** They count as open: for exploring. */
  Optimistic,
  /** They count as closed: for driving only where it is certain. */
  Pessimistic,
}

/**
 * The walls of a square maze, each unknown, open or closed. At first the perimeter is closed and
 * everything else is unknown.
 */
export class Map {
  // By cell, one bit for each heading.
  private open: StaticArray<u8> = new StaticArray<u8>(DIMENSION_MAX * DIMENSION_MAX);
  private closed: StaticArray<u8> = new StaticArray<u8>(DIMENSION_MAX * DIMENSION_MAX);

  constructor(readonly dimension: i32) {
    assert(dimension >= 2 && dimension <= DIMENSION_MAX, "the dimension is outside 2 to 64");
    for (let i = 0; i < dimension; i++) {
      this.closed[cellAt(i, dimension - 1)] |= bit(Heading.Up);
      this.closed[cellAt(dimension - 1, i)] |= bit(Heading.Right);
      this.closed[cellAt(i, 0)] |= bit(Heading.Down);
      this.closed[cellAt(0, i)] |= bit(Heading.Left);
    }
  }

  wall(cell: Cell, heading: Heading): Wall {
    if (this.closed[cell] & bit(heading)) return Wall.Closed;
    return this.open[cell] & bit(heading) ? Wall.Open : Wall.Unknown;
  }

  /**
   * Sets a wall on both of its sides, except that the perimeter stays closed. Returns whether that
   * was news.
   */
  set(cell: Cell, heading: Heading, wall: Wall): bool {
    if (this.wall(cell, heading) == wall || this.isPerimeter(cell, heading)) return false;
    this.setSide(cell, heading, wall);
    this.setSide(toward(cell, heading, 1), opposite(heading), wall);
    return true;
  }

  /** Adds readings. Returns how many walls were not known to be closed before. */
  observe(cell: Cell, heading: Heading, left: i32, front: i32, right: i32): i32 {
    return this.look(cell, turned(heading, Turn.Left), left)
      + this.look(cell, heading, front)
      + this.look(cell, turned(heading, Turn.Right), right);
  }

  /** Whether the robot may drive through that side of a cell. */
  isOpen(view: View, cell: Cell, heading: Heading): bool {
    const open = view == View.Optimistic ? ~this.closed[cell] : this.open[cell];
    return (open & bit(heading)) != 0;
  }

  /** How many cells the robot may drive in that direction, up to a limit. */
  clearCells(view: View, cell: Cell, heading: Heading, limit: i32): i32 {
    let cells = 0;
    while (cells < limit && this.isOpen(view, cell, heading)) {
      cell = toward(cell, heading, 1);
      cells++;
    }
    return cells;
  }

  private look(cell: Cell, heading: Heading, reading: i32): i32 {
    for (; reading > 0; reading--) {
      this.set(cell, heading, Wall.Open);
      cell = toward(cell, heading, 1);
    }
    return this.set(cell, heading, Wall.Closed) ? 1 : 0;
  }

  private isPerimeter(cell: Cell, heading: Heading): bool {
    switch (heading) {
      case Heading.Up: return rowOf(cell) == this.dimension - 1;
      case Heading.Right: return columnOf(cell) == this.dimension - 1;
      case Heading.Down: return rowOf(cell) == 0;
      default: return columnOf(cell) == 0;
    }
  }

  private setSide(cell: Cell, heading: Heading, wall: Wall): void {
    const side = bit(heading);
    this.open[cell] &= ~side;
    this.closed[cell] &= ~side;
    if (wall == Wall.Open) this.open[cell] |= side;
    if (wall == Wall.Closed) this.closed[cell] |= side;
  }
}

function bit(heading: Heading): u8 {
  return 1 << (heading as u8);
}
