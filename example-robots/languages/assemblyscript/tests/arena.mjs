// A match by the rules of the contest, under Node.

import { readFile } from "node:fs/promises";

const DX = [0, 1, 0, -1], DY = [1, 0, -1, 0]; // up, right, down, left

/** Reads the Udacity format: the dimension, then one line per column. */
async function readMaze(file) {
  const [first, ...columns] = (await readFile(file, "utf8")).trim().split("\n");
  const open = columns.map((column) => column.split(",").map(Number));
  const dimension = Number(first);
  /** How many cells are clear from a cell in a direction; a bit is set where there is no wall. */
  const clearCells = (x, y, heading) => {
    let cells = 0;
    while (open[x + cells * DX[heading]][y + cells * DY[heading]] >> heading & 1) cells++;
    return cells;
  };
  return { dimension, clearCells };
}

/** Loads the robot and the journal that it writes to. */
async function load(module) {
  const journal = [];
  const text = (address, bytes) =>
    new TextDecoder().decode(new Uint8Array(robot.memory.buffer, address, bytes));
  const imports = {
    log: (level, address, bytes) => journal.push(text(address, bytes)),
    paint: () => {},
    label: () => {},
    panic: (address, bytes) => { throw new Error(text(address, bytes)); },
  };
  const bytes = await readFile(module);
  const { instance } = await WebAssembly.instantiate(bytes, {
    journal: imports,
  });
  const robot = instance.exports;
  return { robot, journal };
}

/** Plays a robot in a maze; `variant` selects one of its variants. */
export async function play(module, mazeFile, variant = 0) {
  const { dimension, clearCells } = await readMaze(mazeFile);
  const { robot, journal } = await load(module);
  const budget = 1000, longestMove = 3, corner = dimension / 2 - 1;
  const inGoal = (x, y) => x >= corner && x < corner + 2 && y >= corner && y < corner + 2;
  const played = { finished: false, explorationSteps: 0, speedSteps: 0, bumps: 0, journal };
  let x = 0, y = 0, heading = 0, goalSeen = false, inSpeedRun = false;
  robot.start(dimension, 0, 0, corner, corner, 2, 2, budget, 0, longestMove, 1, 30, 0n, variant);
  for (let step = 0; step < budget && !played.finished; step++) {
    const readings = [3, 0, 1].map((turn) => clearCells(x, y, (heading + turn) % 4));
    const address = robot.next_move(...readings);
    const [kind, turn, advance] = new Int8Array(robot.memory.buffer, address, 3);
    if (inSpeedRun) played.speedSteps++;
    else played.explorationSteps++;
    if (kind === 1) {
      if (!goalSeen || inSpeedRun) continue; // the host ignores it
      inSpeedRun = true;
      x = y = heading = 0;
      continue;
    }
    heading = (heading + turn + 3) % 4;
    const travel = advance < 0 ? (heading + 2) % 4 : heading;
    const wish = Math.min(Math.abs(advance), longestMove);
    const cells = Math.min(wish, clearCells(x, y, travel));
    if (cells < wish) played.bumps++;
    x += cells * DX[travel];
    y += cells * DY[travel];
    if (inGoal(x, y)) {
      goalSeen = true;
      played.finished = inSpeedRun;
    }
  }
  return played;
}
