// The journal: how a robot reports to people. `wasmouse run --explain` and the web page show it.

import { Cell, Heading, columnOf, rowOf } from "./geometry";

export enum Level { Debug, Info, Warning, Error }
export enum Color { None, Red, Orange, Yellow, Green, Cyan, Blue, Violet, Gray }

// @ts-ignore: decorator
@external("journal", "log")
declare function hostLog(level: i32, text: usize, bytes: i32): void;

// @ts-ignore: decorator
@external("journal", "paint")
declare function hostPaint(x: i32, y: i32, color: i32): void;

// @ts-ignore: decorator
@external("journal", "label")
declare function hostLabel(x: i32, y: i32, text: usize, bytes: i32): void;

// @ts-ignore: decorator
@external("journal", "panic")
declare function hostPanic(text: usize, bytes: i32): void;

/** Writes a line of text. */
export function log(level: Level, message: string): void {
  const text = String.UTF8.encode(message);
  hostLog(level, changetype<usize>(text), text.byteLength);
}

/** Colours a cell. */
export function paint(cell: Cell, color: Color): void {
  hostPaint(columnOf(cell), rowOf(cell), color);
}

/** Writes at most 8 characters into a cell. */
export function label(cell: Cell, message: string): void {
  const text = String.UTF8.encode(message);
  hostLabel(columnOf(cell), rowOf(cell), changetype<usize>(text), text.byteLength);
}

/**
 * What `throw`, `assert` and failed checks of the runtime call (see `use` in asconfig.json): the
 * message and its place in the source end the match.
 */
export function abort(message: string | null, file: string | null, line: u32, column: u32): void {
  let text = message === null ? "abort" : message;
  if (file !== null) text += " (" + file + ":" + line.toString() + ":" + column.toString() + ")";
  const bytes = String.UTF8.encode(text);
  hostPanic(changetype<usize>(bytes), bytes.byteLength);
}
