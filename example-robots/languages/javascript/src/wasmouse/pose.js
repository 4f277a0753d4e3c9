/** Where a robot is: a cell and a heading. */

import { toward, turned, turnTo } from "./interface.js";

/** The pose in which both runs begin: in the start cell, heading up. */
export function atStart(start) {
  return { cell: start, heading: "up" };
}

/** Whether two poses are the same. */
export function samePose(a, b) {
  return a.cell.x === b.cell.x && a.cell.y === b.cell.y && a.heading === b.heading;
}

/**
 * The pose after a hop. The robot turns to the hop's heading, unless that is behind it; then it
 * drives backwards.
 */
export function hopped(pose, hop) {
  return moved(pose, turnTo(pose.heading, hop.heading) ?? "straight", hop.heading, hop.cells);
}

/**
 * The pose after a turn and then `cells` cells in direction `travel`, which is the new heading or,
 * for a backward move, its opposite.
 */
export function moved(pose, turn, travel, cells) {
  return { cell: toward(pose.cell, travel, cells), heading: turned(pose.heading, turn) };
}
