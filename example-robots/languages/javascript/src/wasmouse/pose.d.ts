/** Where a robot is: a cell and a heading. */
import type { Cell, Heading, Turn } from "./interface.js";
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
export declare function atStart(start: Cell): Pose;
/** Whether two poses are the same. */
export declare function samePose(a: Pose, b: Pose): boolean;
/**
 * The pose after a hop. The robot turns to the hop's heading, unless that is behind it; then it
 * drives backwards.
 */
export declare function hopped(pose: Pose, hop: Hop): Pose;
/**
 * The pose after a turn and then `cells` cells in direction `travel`, which is the new heading or,
 * for a backward move, its opposite.
 */
export declare function moved(pose: Pose, turn: Turn, travel: Heading, cells: number): Pose;
