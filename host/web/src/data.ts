// The matches that a page brings, in the form that docs/PAGE.md describes. Everything in it is
// checked: a damaged page says so and shows nothing wrong.

import type { Rules } from "./core";

/** The version of the form. */
export const VERSION = 1;

export interface PageMatch {
  robot: number;
  maze: number;
  seed: number;
  transcript: Uint8Array;
}

export interface PageData {
  rules: Rules;
  robots: string[];
  mazes: { name: string; identity: Uint8Array }[];
  /** In decimal: they may be larger than numbers can be. */
  seeds: string[];
  matches: PageMatch[];
}

export class DataError extends Error {}

/** No matches at all: what a page without data has. */
export const NO_DATA: PageData = { rules: [1, 0, 1, 1], robots: [], mazes: [], seeds: [], matches: [] };

/** Reads the index, and the bytes of mazes and transcripts that it refers to. */
export function readData(index: string, bytes: Uint8Array): PageData {
  let json: unknown;
  try {
    json = JSON.parse(index);
  } catch {
    throw new DataError("the index is not JSON");
  }
  const root = object(json, "the index");
  if (root["version"] !== VERSION) {
    throw new DataError(`version ${String(root["version"])} is not supported, only ${VERSION}`);
  }
  const rules = list(root["rules"], "rules").map((it) => number(it, "rules", 0xffff_ffff));
  if (rules.length !== 4) {
    throw new DataError("rules: expected 4 numbers");
  }
  let offset = 0;
  const take = (length: number, what: string) => {
    if (length > bytes.length - offset) {
      throw new DataError(`${what}: the data is truncated`);
    }
    return bytes.subarray(offset, (offset += length));
  };
  const robots = list(root["robots"], "robots").map((it) => text(it, "robots"));
  const seeds = list(root["seeds"], "seeds").map((it) => text(it, "seeds"));
  const mazes = list(root["mazes"], "mazes").map((it, index) => {
    const what = `maze ${index}`;
    const [name, length] = list(it, what);
    return { name: text(name, what), identity: take(number(length, what), what) };
  });
  const matches = list(root["matches"], "matches").map((it, index) => {
    const what = `match ${index}`;
    const [robot, maze, seed, length] = list(it, what);
    return {
      robot: number(robot, what, robots.length - 1),
      maze: number(maze, what, mazes.length - 1),
      seed: number(seed, what, seeds.length - 1),
      transcript: take(number(length, what), what),
    };
  });
  if (offset !== bytes.length) {
    throw new DataError("the data is longer than the index says");
  }
  return { rules: rules as unknown as Rules, robots, mazes, seeds, matches };
}

function object(value: unknown, what: string): Record<string, unknown> {
  if (typeof value !== "object" || value === null || Array.isArray(value)) {
    throw new DataError(`${what}: expected an object`);
  }
  return value as Record<string, unknown>;
}

function list(value: unknown, what: string): unknown[] {
  if (!Array.isArray(value)) {
    throw new DataError(`${what}: expected a list`);
  }
  return value;
}

function text(value: unknown, what: string): string {
  if (typeof value !== "string") {
    throw new DataError(`${what}: expected text`);
  }
  return value;
}

function number(value: unknown, what: string, max = 0xffff_ffff): number {
  if (typeof value !== "number" || !Number.isInteger(value) || value < 0 || value > max) {
    throw new DataError(`${what}: expected a number from 0 to ${max}`);
  }
  return value;
}

/** The bytes of base64 of a gzip file. */
export async function inflate(base64: string): Promise<Uint8Array<ArrayBuffer>> {
  let packed: Uint8Array<ArrayBuffer>;
  try {
    const binary = atob(base64.trim());
    packed = new Uint8Array(binary.length);
    for (let index = 0; index < binary.length; index += 1) {
      packed[index] = binary.charCodeAt(index);
    }
  } catch {
    throw new DataError("the data is not base64");
  }
  try {
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  } catch {
    throw new DataError("the compressed data is damaged");
  }
}
