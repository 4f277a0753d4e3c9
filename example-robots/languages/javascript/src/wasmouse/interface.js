/**
 * What a robot and the host tell each other, as in `wit/robot.wit` of wasmouse.
 *
 * Distances (readings, `Move.advance`, `Briefing.longestMove`) are in units. All current rulesets
 * have 1 unit per cell, so a distance is a number of cells.
 */

/** All four headings, clockwise from up. */
export const HEADINGS = ["up", "right", "down", "left"];
const TURNS = ["straight", "right", null, "left"];
const NUMBERS = { up: 0, right: 1, down: 2, left: 3 };
const QUARTERS = { left: 3, straight: 0, right: 1 };

/** The place of a heading in {@link HEADINGS}. */
export function headingNumber(heading) {
  return NUMBERS[heading];
}

/** The heading after a turn on the spot. */
export function turned(heading, turn) {
  return HEADINGS[(NUMBERS[heading] + QUARTERS[turn]) & 3];
}

/** The opposite heading. */
export function opposite(heading) {
  return HEADINGS[(NUMBERS[heading] + 2) & 3];
}

/**
 * The turn from a heading to another; `null` if that is behind the robot, because one step cannot
 * turn that far.
 */
export function turnTo(heading, target) {
  return TURNS[(NUMBERS[target] + 4 - NUMBERS[heading]) & 3];
}

/**
 * The cell `distance` cells away in that direction, ignoring walls and the size of the maze.
 */
export function toward({ x, y }, heading, distance) {
  switch (heading) {
    case "up":
      return { x, y: y + distance };
    case "right":
      return { x: x + distance, y };
    case "down":
      return { x, y: y - distance };
    case "left":
      return { x: x - distance, y };
  }
}

/** Whether `cell` lies in the rectangle. */
export function contains({ origin, width, height }, { x, y }) {
  return x >= origin.x && y >= origin.y && x < origin.x + width && y < origin.y + height;
}

/** All cells, column by column from the left, each from the bottom up. */
export function cells({ origin, width, height }) {
  const all = [];
  for (let dx = 0; dx < width; dx++) {
    for (let dy = 0; dy < height; dy++) all.push({ x: origin.x + dx, y: origin.y + dy });
  }
  return all;
}

/**
 * The goal room of a contest maze: the 2 x 2 cells in the centre, or the single centre cell if
 * `dimension` is odd.
 */
export function center(dimension) {
  const low = Math.floor((dimension - 1) / 2);
  const side = dimension % 2 === 0 ? 2 : 1;
  return { origin: { x: low, y: low }, width: side, height: side };
}

/** Turns, then drives `advance` cells along the new heading; backwards when it is negative. */
export function drive(turn, advance) {
  return { tag: "move", val: { turn, advance } };
}

/** Ends the exploration run. */
export const RESET = { tag: "reset" };

/** The briefing of the ruleset `udacity` for a contest maze of this size, for tests. */
export function contestBriefing(dimension) {
  return {
    dimension,
    start: { x: 0, y: 0 },
    goal: center(dimension),
    budget: 1000,
    budgetScope: "both-runs",
    longestMove: 3,
    unitsPerCell: 1,
    explorationDivisor: 30,
    seed: 0n,
    variant: 0,
  };
}
