/**
 * The flood robot: flood fill, treating unknown walls as open.
 *
 * - *Exploration run*: unknown walls count as open. After every reading it finds the path with the
 *   fewest steps to the goal and takes its first step. In the goal it resets.
 * - *Speed run*: the fewest steps through walls known to be open.
 *
 * Between paths of equal length it prefers to drive straight, then right, then left, then
 * backwards, and prefers long moves to short ones.
 */

import { cells, hopped, samePose, Search, Tracker } from "./wasmouse/index.js";

/** @import { Action, Briefing, Pose, Robot, Sensors, View } from "./wasmouse/index.js" */

/** The robot of a match. */
class Flood {
  /** @param {Briefing} briefing */
  constructor(briefing) {
    if (briefing.variant !== 0) throw new RangeError("this robot has only variant 0");
    this.tracker = new Tracker(briefing);
    this.search = new Search(briefing.dimension, briefing.longestMove);
    this.goal = cells(briefing.goal);
    /**
     * The next pose on a route of the last search that is known to be whole.
     * @type {Pose | null}
     */
    this.onRoute = null;
  }

  /**
   * The action for the readings at the current position. Called once per step.
   * @param {Sensors} sensors
   * @returns {Action}
   */
  nextMove(sensors) {
    const news = this.tracker.observe(sensors);
    if (news.closed > 0) this.onRoute = null;
    if (this.tracker.run === "speed") return this.driveToGoal("pessimistic");
    if (!this.tracker.mayReset()) return this.driveToGoal("optimistic");
    this.onRoute = null;
    return this.tracker.reset();
  }

  /**
   * The first step of a shortest path to the goal. Searches only when the path of the last search
   * is no longer whole: walls that close make nothing shorter.
   * @param {View} view
   * @returns {Action}
   */
  driveToGoal(view) {
    const pose = this.tracker.pose;
    const passages = this.tracker.map.passages(view);
    const isOnRoute = this.onRoute !== null && samePose(this.onRoute, pose);
    let hop = isOnRoute
      ? this.search.nextHop(passages, pose)
      : this.search.firstHop(passages, pose);
    if (hop === null) {
      this.search.fillUntil(passages, this.goal, pose.cell);
      hop = this.search.nextHop(passages, pose);
    }
    if (hop === null) {
      this.onRoute = null;
      return this.tracker.turn("right");
    }
    this.onRoute = hopped(pose, hop);
    return this.tracker.go(hop.heading, hop.cells);
  }
}

/**
 * The robot for a match. Everything in it stays until the match ends.
 * @param {Briefing} briefing
 * @returns {Robot}
 */
export function start(briefing) {
  return new Flood(briefing);
}
