/** Where a robot is: a cell and a heading. */

import { toward, turned, turnTo } from "./interface";
import type { Cell, Heading, Turn } from "./interface";

/** A move in a straight line, in one step. */
export interface Hop {
  /** The direction of travel in the maze. */
  readonly heading: Heading;
  /** How far, in cells, at least 1. */
  readonly cells: number;
}

/** A cell and a heading. */
export interface Pose {
  readonly cell: Cell;
  readonly heading: Heading;
}

/** The pose in which both runs begin: in the start cell, heading up. */
export function atStart(start: Cell): Pose {
  return { cell: start, heading: "up" };
}

/** Whether two poses are the same. */
export function samePose(a: Pose, b: Pose): boolean {
  return a.cell.x === b.cell.x && a.cell.y === b.cell.y && a.heading === b.heading;
}

/**
 * The pose after a hop. The robot turns to the hop's heading, unless that is behind it; then it
 * drives backwards.
 */
export function hopped(pose: Pose, hop: Hop): Pose {
  return moved(pose, turnTo(pose.heading, hop.heading) ?? "straight", hop.heading, hop.cells);
}

/**
 * The pose after a turn and then `cells` cells in direction `travel`, which is the new heading or,
 * for a backward move, its opposite.
 */
export function moved(pose: Pose, turn: Turn, travel: Heading, cells: number): Pose {
  return { cell: toward(pose.cell, travel, cells), heading: turned(pose.heading, turn) };
}
