/** The toolkit against the cases in `vectors.json`, which come from the Rust SDK. */

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test from "node:test";

import { start } from "../src/robot.js";
import { cells, center, HEADINGS, MazeMap, Search, turned, turnTo } from "../src/wasmouse/index.js";
import { Maze, play, summary } from "../src/wasmouse/arena.js";
import { seedRandom } from "../src/wasmouse/runtime.js";

const VECTORS = new URL("vectors.json", import.meta.url);
const vectors = JSON.parse(readFileSync(VECTORS, "utf8"));

const SIGNS = { unknown: "?", open: ".", closed: "#" };

function pose({ x, y, heading }) {
  return { cell: { x, y }, heading };
}

function word(action) {
  if (action.tag === "reset") return "reset";
  return `${action.val.turn.charAt(0).toUpperCase()}${action.val.advance}`;
}

function allCells(dimension) {
  return cells({ origin: { x: 0, y: 0 }, width: dimension, height: dimension });
}

test("turns", () => {
  for (const { from, to, turn, turned: by, after } of vectors.turns) {
    if (by === undefined) assert.equal(turnTo(from, to), turn);
    else assert.equal(turned(from, by), after);
  }
});

test("maps", () => {
  for (const { dimension, observations, walls } of vectors.maps) {
    const map = new MazeMap(dimension);
    for (const { sensors, opened, closed, ...at } of observations) {
      const [left, front, right] = sensors;
      assert.deepEqual(map.observe(pose(at), { left, front, right }), { opened, closed });
    }
    for (const cell of allCells(dimension)) {
      const found = HEADINGS.map((heading) => SIGNS[map.wall(cell, heading)]).join("");
      assert.equal(found, walls[cell.x][cell.y]);
    }
  }
});

test("searches", () => {
  for (const { maze: columns, longest_move, steps, from, steps_until, route } of vectors.searches) {
    const maze = new Maze(columns);
    const map = new MazeMap(maze.dimension);
    const all = allCells(maze.dimension);
    for (const cell of all) {
      for (const heading of HEADINGS) {
        map.set(cell, heading, maze.isOpen(cell, heading) ? "open" : "closed");
      }
    }
    const goal = cells(center(maze.dimension));
    const search = new Search(maze.dimension, longest_move);
    search.fill(map.known, goal);
    for (const cell of all) assert.equal(search.steps(cell), steps[cell.x][cell.y]);
    search.fillUntil(map.known, goal, from);
    for (const cell of all) assert.equal(search.steps(cell), steps_until[cell.x][cell.y]);
    const hops = [...search.route(map.known, pose(from))];
    assert.deepEqual(hops.map((hop) => [hop.heading, hop.cells]), route);
  }
});

test("matches", () => {
  for (const { maze, summary: expected, actions } of vectors.matches) {
    const played = play(start, new Maze(maze));
    assert.equal(summary(played), expected);
    assert.equal(played.actions.map(word).join(" "), actions);
  }
});

test("chance depends on the seed alone", () => {
  const random = Math.random;
  const numbers = (seed) => {
    seedRandom(seed);
    return Array.from({ length: 1000 }, Math.random);
  };
  try {
    assert.deepEqual(numbers(2n ** 64n - 1n), numbers(2n ** 64n - 1n));
    assert.notDeepEqual(numbers(1n), numbers(2n ** 32n));
    const mean = numbers(7n).reduce((sum, it) => sum + it / 1000, 0);
    assert.ok(mean > 0.45 && mean < 0.55, `${mean}`);
  } finally {
    Math.random = random;
  }
});
