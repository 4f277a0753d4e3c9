/**
 * Matches for a robot's tests, without WebAssembly and without the host.
 *
 * A small, independent implementation of the contest rules. It has no fuel and no limits.
 */

import { contains, contestBriefing, headingNumber, opposite, toward, turned } from "./interface.js";

/** The outcome in one line, such as `finished 31 + 21: 22.033`. */
export function summary(played) {
  const steps = `${played.explorationSteps} + ${played.speedSteps}`;
  const score = played.speedSteps + played.explorationSteps / 30;
  if (played.finished) return `finished ${steps}: ${score.toFixed(3)}`;
  return played.goalSeen ? `goal seen ${steps}` : `goal not seen ${steps}`;
}

/**
 * A maze by columns from the left, each from the bottom up. A cell is the sum of its open sides:
 * 1 up, 2 right, 4 down, 8 left.
 */
export class Maze {
  constructor(columns) {
    this.columns = columns;
    this.dimension = columns.length;
  }

  /** Reads the text format of the contest: the dimension, then a line per column. */
  static parse(text) {
    const [first, ...lines] = text.trim().split(/\s+/);
    const columns = lines.map((line) => line.split(",").map(Number));
    if ([columns, ...columns].some((column) => column.length !== Number(first))) {
      throw new RangeError("a maze has as many columns and rows as its first line says");
    }
    return new Maze(columns);
  }

  /** Whether there is no wall on that side of `cell`. */
  isOpen({ x, y }, heading) {
    return ((this.columns[x][y] >> headingNumber(heading)) & 1) !== 0;
  }

  /** How many cells are free in that direction. */
  sight(cell, heading) {
    let count = 0;
    while (this.isOpen(cell, heading)) {
      cell = toward(cell, heading, 1);
      count++;
    }
    return count;
  }
}

/** A test maze of the contest, 12 x 12. The fewest steps of a speed run are 17. */
export const MAZE_01 = Maze.parse(`12
1,5,7,5,5,5,7,5,7,5,5,6
3,5,14,3,7,5,15,4,9,5,7,12
11,6,10,10,9,7,13,6,3,5,13,4
10,9,13,12,3,13,5,12,9,5,7,6
9,5,6,3,15,5,5,7,7,4,10,10
3,5,15,14,10,3,6,10,11,6,10,10
9,7,12,11,12,9,14,9,14,11,13,14
3,13,5,12,2,3,13,6,9,14,3,14
11,4,1,7,15,13,7,13,6,9,14,10
11,5,6,10,9,7,13,5,15,7,14,8
11,5,12,10,2,9,5,6,10,8,9,6
9,5,5,13,13,5,5,12,9,5,5,12`);

/** Plays one match by the rules of the ruleset `udacity`. */
export function play(start, maze, briefing = contestBriefing(maze.dimension)) {
  const robot = start(briefing);
  const played = {
    finished: false,
    goalSeen: false,
    explorationSteps: 0,
    speedSteps: 0,
    bumps: 0,
    actions: [],
  };
  let cell = briefing.start;
  let heading = "up";
  let exploring = true;
  while (played.actions.length < briefing.budget && !played.finished) {
    const action = robot.nextMove({
      left: maze.sight(cell, turned(heading, "left")),
      front: maze.sight(cell, heading),
      right: maze.sight(cell, turned(heading, "right")),
    });
    played.actions.push(action);
    if (exploring) played.explorationSteps++;
    else played.speedSteps++;
    if (action.tag === "reset") {
      if (exploring && played.goalSeen) {
        exploring = false;
        cell = briefing.start;
        heading = "up";
      }
      continue;
    }
    const { turn, advance } = action.val;
    heading = turned(heading, turn);
    const travel = advance >= 0 ? heading : opposite(heading);
    const wish = Math.min(Math.abs(advance), briefing.longestMove);
    const cells = Math.min(wish, maze.sight(cell, travel));
    if (cells < wish) played.bumps++;
    cell = toward(cell, travel, cells);
    if (contains(briefing.goal, cell)) {
      if (exploring) played.goalSeen = true;
      else played.finished = true;
    }
  }
  return played;
}
