// Run with `npm test`.

import assert from "node:assert/strict";
import test from "node:test";

import { play } from "./arena.mjs";

const MODULE = new URL("../build/robot.wasm", import.meta.url);
const MAZE = new URL("maze.txt", import.meta.url);

test("the robot finishes a maze", async () => {
  const played = await play(MODULE, MAZE);
  assert.equal(played.finished, true);
  assert.equal(played.bumps, 0);
  assert.deepEqual([played.explorationSteps, played.speedSteps], [31, 21]);
});

test("an unknown variant is rejected", async () => {
  await assert.rejects(play(MODULE, MAZE, 7), /this robot has only the variant 0 \(assembly\/robot.ts/);
});
