/**
 * Connects `start` of `robot.js` with the host. There is no need to change this file.
 */

import * as host from "wasmouse:robot/journal@0.2.0";
import { start } from "./robot.js";
import { connect } from "./wasmouse/journal.js";
import { connectConsole, places, seedRandom } from "./wasmouse/runtime.js";

let robot;

/** What the host calls. */
export const controller = {
  start(briefing) {
    connect(host);
    connectConsole();
    try {
      // Engines disagree about whether a large number is a `bigint`.
      const seed = BigInt(briefing.seed);
      seedRandom(seed);
      robot = start({ ...briefing, seed });
    } catch (error) {
      fail(error);
    }
  },

  nextMove(sensors) {
    try {
      if (!robot) throw new Error("the host calls `start` first");
      return checked(robot.nextMove(sensors));
    } catch (error) {
      fail(error);
    }
  },
};

/** Rejects what does not fit into the interface, where the engine would only trap. */
function checked(action) {
  if (action?.tag === "reset") return action;
  if (action?.tag !== "move" || !action.val) {
    throw new TypeError(`\`nextMove\` returned ${JSON.stringify(action)} and not an action`);
  }
  const { turn, advance } = action.val;
  if (!["left", "straight", "right"].includes(turn)) {
    throw new TypeError(`\`turn\` is ${JSON.stringify(turn)} and not left, straight or right`);
  }
  if (!(Number.isInteger(advance) && advance >= -128 && advance <= 127)) {
    throw new RangeError(`\`advance\` is ${advance} and not a whole number from -128 to 127`);
  }
  return action;
}

/** Ends the match with the error and the line where it was thrown; the other lines are logged. */
function fail(error) {
  const lines = places(error);
  for (const line of lines) host.log("error", `  at ${line}`);
  const what = error instanceof Error ? `${error.name}: ${error.message}` : `thrown: ${String(error)}`;
  host.panic(lines.length > 0 ? `${what} (${lines[0]})` : what);
}
