/**
 * How a robot reports to people: log messages, colours, labels, beliefs about walls.
 *
 * In a match the functions call the host, and `wasmouse run --log` shows what they wrote. Elsewhere
 * they do nothing. No call returns anything, so the journal cannot influence a match. Every call
 * costs fuel: 200, plus 1 per byte of text. `console.log` and its siblings work, too.
 *
 * To report an error from which the robot cannot recover, throw an `Error`.
 */


let host;

/** Connects the functions of this module with the host. */
export function connect(to) {
  host = to;
}

/** Writes a line of text. */
export function log(level, message) {
  host?.log(level, message);
}

/** Colours a cell. Cells outside the maze are ignored. */
export function paint(cell, color) {
  host?.paint(cell, color);
}

/**
 * Writes a short text into a cell. At most 8 characters are shown; the empty text removes the
 * label. Cells outside the maze are ignored.
 */
export function label(cell, text) {
  host?.label(cell, text);
}

/**
 * States what the robot believes about the wall on one side of a cell. Cells outside the maze are
 * ignored.
 */
export function wall(cell, side, belief) {
  host?.wall(cell, side, belief);
}
