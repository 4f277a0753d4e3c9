// Directions, cells and poses. x grows to the right, y grows upward; (0, 0) is the bottom left cell.

/** The largest maze, in cells along each side. */
export const DIMENSION_MAX: i32 = 64;

/** A direction in the maze, clockwise. The robot starts both runs heading up. */
export enum Heading { Up, Right, Down, Left }

/** A rotation on the spot. */
export enum Turn { Left, Straight, Right }

/** `heading` after a turn. */
export function turned(heading: Heading, turn: Turn): Heading {
  return ((heading + turn + 3) & 3) as Heading;
}

export function opposite(heading: Heading): Heading {
  return ((heading + 2) & 3) as Heading;
}

/** A cell as a number: objects would be allocated, and nothing frees them in a match. */
export type Cell = i32;

export function cellAt(x: i32, y: i32): Cell {
  return x * DIMENSION_MAX + y;
}

export function columnOf(cell: Cell): i32 {
  return cell / DIMENSION_MAX;
}

export function rowOf(cell: Cell): i32 {
  return cell % DIMENSION_MAX;
}

/** The cell that many cells away. The caller knows that it is in the maze. */
export function toward(cell: Cell, heading: Heading, cells: i32): Cell {
  switch (heading) {
    case Heading.Up: return cell + cells;
    case Heading.Right: return cell + cells * DIMENSION_MAX;
    case Heading.Down: return cell - cells;
    default: return cell - cells * DIMENSION_MAX;
  }
}

/** A rectangle of cells; `x` and `y` are its bottom left one. */
export class Area {
  constructor(public x: i32, public y: i32, public width: i32, public height: i32) {}

  contains(cell: Cell): bool {
    const x = columnOf(cell) - this.x, y = rowOf(cell) - this.y;
    return x >= 0 && x < this.width && y >= 0 && y < this.height;
  }
}
