/** The robot plays mazes, without WebAssembly. */

import assert from "node:assert/strict";
import test from "node:test";

import { start } from "../src/robot";
import { contestBriefing } from "../src/wasmouse";
import { MAZE_01, play, summary } from "../src/wasmouse/arena";

test("plays a maze", () => {
  const played = play(start, MAZE_01);
  assert.equal(summary(played), "finished 31 + 21: 22.033");
  assert.equal(played.bumps, 0);
});

test("rejects unknown variants", () => {
  assert.throws(() => start({ ...contestBriefing(12), variant: 1 }), /variant 0/);
});
