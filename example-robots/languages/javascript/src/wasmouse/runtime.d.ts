/**
 * What the engines in WebAssembly lack or do their own way: a console, chance that is the same in
 * every match with the same seed, and places of errors in your sources.
 */
/** From a line of the bundle on, these are the lines of a source; `wasmouse build` adds them. */
interface Lines {
  readonly sources: readonly string[];
  /** Line of the bundle, number of the source or -1, line of the source. */
  readonly starts: readonly (readonly [number, number, number])[];
}
declare global {
  var wasmouseLines: Lines | undefined;
}
/** Makes `console` write to the journal. */
export declare function connectConsole(): void;
/** Makes `Math.random` depend on the seed of the match, and on nothing else. */
export declare function seedRandom(seed: bigint): void;
/** The places in your sources where an error passed, from where it was thrown. */
export declare function places(error: unknown): string[];
export {};
