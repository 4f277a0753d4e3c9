/** The journal of the host: what `src/wasmouse/journal.ts` calls in a match. */
declare module "wasmouse:robot/journal@0.2.0" {
  type Cell = import("./wasmouse/interface").Cell;
  type Heading = import("./wasmouse/interface").Heading;
  type Level = import("./wasmouse/journal").Level;
  type Color = import("./wasmouse/journal").Color;
  type Belief = import("./wasmouse/journal").Belief;

  /** Writes a line of text. */
  export function log(level: Level, message: string): void;
  /** Colours a cell. Cells outside the maze are ignored. */
  export function paint(cell: Cell, color: Color): void;
  /** Writes a short text into a cell. */
  export function label(cell: Cell, text: string): void;
  /** States what the robot believes about the wall on one side of a cell. */
  export function wall(cell: Cell, side: Heading, belief: Belief): void;
  /**
   * Reports an error from which the robot cannot recover, and ends the match with the fault `panic`
   * and this message. Does not return.
   */
  export function panic(message: string): never;
}
