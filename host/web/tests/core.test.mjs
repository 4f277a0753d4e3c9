// The core of the page, without a browser: it has to agree with the core of the host.

import assert from "node:assert/strict";
import { mkdtemp, rm } from "node:fs/promises";
import os from "node:os";
import path from "node:path";
import { before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { gunzipSync } from "node:zlib";
import { build } from "esbuild";
import { readSample } from "./browser.mjs";

let Core;
let CoreError;
let bytes;
before(async () => {
  const outfile = path.join(await mkdtemp(path.join(os.tmpdir(), "wasmouse-core-")), "core.mjs");
  await build({ entryPoints: ["src/core.ts"], bundle: true, format: "esm", outfile, logLevel: "error" });
  ({ Core, CoreError } = await import(pathToFileURL(outfile).href));
  await rm(path.dirname(outfile), { recursive: true });
  // As it is in a page, so that what is tested is what people get.
  const page = await readSample("one.html");
  const base64 = /id="wasmouse-core">([^<]*)</.exec(page)[1];
  bytes = gunzipSync(Buffer.from(base64, "base64"));
});

test("a hundred random transcripts have the same trace digest as on the host", async () => {
  const core = await Core.load(bytes);
  const matches = JSON.parse(await readSample("transcripts.json"));
  assert.equal(matches.length, 100);
  let steps = 0;
  for (const it of matches) {
    const match = core.openMatch(it.rules, Uint8Array.from(it.maze), Uint8Array.from(it.transcript));
    assert.equal(match.about.traceDigest, it.digest);
    assert.equal(match.about.last, it.steps);
    assert.equal(match.poses.length, 4 * (it.steps + 1));
    assert.equal(match.audit.length, 3 * (it.steps + 1));
    for (const at of [0, Math.floor(it.steps / 2), it.steps]) {
      const frame = match.frame(at);
      assert.deepEqual([frame.run, frame.x, frame.y, frame.heading], [...match.poses.subarray(4 * at, 4 * at + 4)]);
      assert.equal(frame.explorationSteps + frame.speedSteps, at);
      assert.equal(frame.optimistic, match.audit[3 * at + 1]);
      const visits = frame.visits.reduce((sum, it) => sum + it, 0);
      assert.ok(visits >= 1 && frame.distances.length === match.about.dimension ** 2);
    }
    assert.throws(() => match.frame(it.steps + 1), /the match has \d+ steps/);
    steps += it.steps;
    match.close();
    assert.throws(() => match.frame(0), /no match has the handle/);
  }
  assert.ok(steps > 10_000, `${steps} steps`);
});

test("damaged matches are refused with a message", async () => {
  const core = await Core.load(bytes);
  const [match] = JSON.parse(await readSample("transcripts.json"));
  const [maze, transcript] = [Uint8Array.from(match.maze), Uint8Array.from(match.transcript)];
  const rejected = (change, message) => {
    const parts = { rules: [...match.rules], maze: maze.slice(), transcript: transcript.slice() };
    Object.assign(parts, change(parts) ?? {});
    assert.throws(
      () => core.openMatch(parts.rules, parts.maze, parts.transcript),
      (error) => error instanceof CoreError && message.test(error.message),
      String(message),
    );
  };
  rejected((it) => void (it.maze[9] ^= 1), /the maze is damaged/);
  rejected((it) => ({ maze: it.maze.subarray(1) }), /the maze is damaged/);
  rejected(() => ({ maze: new Uint8Array() }), /the maze is damaged/);
  rejected(() => ({ transcript: new Uint8Array() }), /truncated/);
  rejected((it) => void (it.transcript[0] = 9), /version 9/);
  rejected((it) => void (it.transcript[1] = 99), /byte 1 of the transcript is invalid/);
  rejected((it) => ({ transcript: it.transcript.subarray(0, -1) }), /before the match does/);
  rejected((it) => ({ transcript: Uint8Array.of(...it.transcript, 50) }), /after the end/);
  rejected((it) => void (it.rules[0] = 0), /a number of the rules is 0/);
  rejected((it) => void (it.rules[1] = 7), /unknown budget scope 7/);
  rejected((it) => void (it.rules[2] = 0), /a number of the rules is 0/);
  rejected((it) => void (it.rules[0] += 1), /before the match does/);
  rejected(() => ({ rules: [0xffff_ffff, 0, 3, 30], transcript: new Uint8Array(300_000).fill(50).fill(1, 0, 1).fill(0, 1, 2) }), /more than 200000 steps/);
  // Random bytes never trap: a trap would be an internal error.
  let seed = 1;
  for (let round = 0; round < 300; round += 1) {
    const random = transcript.slice();
    for (let change = 0; change < 3; change += 1) {
      seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0;
      random[seed % random.length] = seed >>> 24;
    }
    try {
      core.openMatch(match.rules, maze, random).close();
    } catch (error) {
      assert.ok(error instanceof CoreError && !/internal/.test(error.message), error.message);
    }
  }
});

test("an instance that traps is replaced", async () => {
  const core = await Core.load(bytes);
  const [it] = JSON.parse(await readSample("transcripts.json"));
  const open = () => core.openMatch(it.rules, Uint8Array.from(it.maze), Uint8Array.from(it.transcript));
  const before = open();
  // There is no way to a trap through the interface, so the memory is taken away.
  const exports = Object.getOwnPropertyNames(WebAssembly.Memory.prototype);
  assert.ok(exports.includes("buffer"));
  const { set } = Uint8Array.prototype;
  Uint8Array.prototype.set = () => {
    throw new WebAssembly.RuntimeError("unreachable");
  };
  // The bytes of the match are put together with the same function, so only a replay comes so far.
  assert.throws(() => core.openReplay(new Uint8Array(3)), /internal error/);
  Uint8Array.prototype.set = set;
  assert.throws(() => before.frame(0), /restarted/);
  assert.equal(open().about.traceDigest, it.digest);
});
