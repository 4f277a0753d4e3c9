/**
 * What the engines in WebAssembly lack or do their own way: a console, chance that is the same in
 * every match with the same seed, and places of errors in your sources.
 */

import { log } from "./journal.js";

function text(value) {
  if (typeof value !== "object" || value === null) return String(value);
  return value instanceof Error ? `${value.name}: ${value.message}` : JSON.stringify(value);
}

/** Makes `console` write to the journal. */
export function connectConsole() {
  const writer =
    (level) =>
    (...values) => {
      for (const line of values.map(text).join(" ").split("\n")) log(level, line);
    };
  const methods = {
    debug: writer("debug"),
    log: writer("info"),
    info: writer("info"),
    warn: writer("warning"),
    error: writer("error"),
  };
  Object.assign((globalThis.console ??= {}), methods);
}

/** Makes `Math.random` depend on the seed of the match, and on nothing else. */
export function seedRandom(seed) {
  let state = Number(seed & 0xffffffffn) ^ Math.imul(Number(seed >> 32n), 0x9e3779b1);
  // SplitMix32: good enough for a robot, and cheap.
  const next = () => {
    state = (state + 0x9e3779b9) | 0;
    let bits = state ^ (state >>> 16);
    bits = Math.imul(bits, 0x21f0aaad);
    bits = Math.imul(bits ^ (bits >>> 15), 0x735a2d97);
    return (bits ^ (bits >>> 15)) >>> 0;
  };
  Math.random = () => ((next() >>> 5) * 0x4000000 + (next() >>> 6)) / 0x20000000000000;
}

/** The places in your sources where an error passed, from where it was thrown. */
export function places(error) {
  const stack = error instanceof Error ? (error.stack ?? "") : "";
  const places = [];
  for (const frame of stack.split("\n")) {
    const match = /:(\d+)(:\d+)?\)?$/.exec(frame.trim());
    const place = match && sourceLine(Number(match[1]));
    if (place && !/src\/controller\.[jt]s/.test(place)) places.push(place);
  }
  return places;
}

function sourceLine(line) {
  if (!globalThis.wasmouseLines) return undefined;
  const { sources, starts } = globalThis.wasmouseLines;
  const start = starts.findLast(([first]) => first <= line);
  if (!start || start[1] < 0) return undefined;
  return `${sources[start[1]]}:${start[2] + line - start[0]}`;
}
