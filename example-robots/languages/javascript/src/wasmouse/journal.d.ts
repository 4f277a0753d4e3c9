/**
 * How a robot reports to people: log messages, colours, labels, beliefs about walls.
 *
 * In a match the functions call the host, and `wasmouse run --log` shows what they wrote. Elsewhere
 * they do nothing. No call returns anything, so the journal cannot influence a match. Every call
 * costs fuel: 200, plus 1 per byte of text. `console.log` and its siblings work, too.
 *
 * To report an error from which the robot cannot recover, throw an `Error`.
 */
import type { Cell, Heading } from "./interface.js";
/**
 * The severity of a log message.
 *
 * - `debug`: For the author of the robot.
 * - `info`: For anyone who watches.
 * - `warning`: Something unexpected that the robot can handle.
 * - `error`: Something that should not have happened.
 */
export type Level = "debug" | "info" | "warning" | "error";
/** The colour of a cell. `none` removes the colour of the cell. */
export type Color = "none" | "red" | "orange" | "yellow" | "green" | "cyan" | "blue" | "violet" | "gray";
/**
 * What the robot believes about one wall.
 *
 * - `unknown`: Not known.
 * - `open`: There is no wall.
 * - `closed`: There is a wall.
 */
export type Belief = "unknown" | "open" | "closed";
/** What the controller connects in a match. */
export interface Host {
  log(level: Level, message: string): void;
  paint(cell: Cell, color: Color): void;
  label(cell: Cell, text: string): void;
  wall(cell: Cell, side: Heading, belief: Belief): void;
}
/** Connects the functions of this module with the host. */
export declare function connect(to: Host): void;
/** Writes a line of text. */
export declare function log(level: Level, message: string): void;
/** Colours a cell. Cells outside the maze are ignored. */
export declare function paint(cell: Cell, color: Color): void;
/**
 * Writes a short text into a cell. At most 8 characters are shown; the empty text removes the
 * label. Cells outside the maze are ignored.
 */
export declare function label(cell: Cell, text: string): void;
/**
 * States what the robot believes about the wall on one side of a cell. Cells outside the maze are
 * ignored.
 */
export declare function wall(cell: Cell, side: Heading, belief: Belief): void;
