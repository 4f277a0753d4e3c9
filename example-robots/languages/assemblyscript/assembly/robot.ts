// The flood robot: drives along a shortest path to the goal, taking unknown walls for open ones,
// resets in the goal, and drives the shortest path that it knows.

import { Cell, Heading, Turn } from "../wasmouse/geometry";
import { View } from "../wasmouse/map";
import { Action, Briefing } from "../wasmouse/robot";
import { Search } from "../wasmouse/search";
import { Run, Tracker } from "../wasmouse/tracker";

export class Robot {
  private tracker: Tracker;
  private toGoal: Search;
  // Where the last hop leads, if it was part of a route that was whole.
  private onRoute: bool = false;
  private expectedCell: Cell = 0;
  private expectedHeading: Heading = Heading.Up;

  constructor(briefing: Briefing) {
    assert(briefing.variant == 0, "this robot has only the variant 0");
    this.tracker = new Tracker(briefing);
    this.toGoal = new Search(briefing.longestMove);
  }

  nextMove(left: i32, front: i32, right: i32): Action {
    if (this.tracker.observe(left, front, right) > 0) this.onRoute = false;
    if (this.tracker.run == Run.Speed) return this.driveToGoal(View.Pessimistic);
    if (this.tracker.mayReset()) {
      this.onRoute = false;
      return this.tracker.reset();
    }
    return this.driveToGoal(View.Optimistic);
  }

  /**
   * The first step of a shortest path. Searches only when the path of the last search is no longer
   * whole: walls that close make nothing shorter.
   */
  private driveToGoal(view: View): Action {
    const map = this.tracker.map, cell = this.tracker.cell, heading = this.tracker.heading;
    const asExpected =
      this.onRoute && cell == this.expectedCell && heading == this.expectedHeading;
    let hop = asExpected
      ? this.toGoal.nextHop(map, view, cell, heading)
      : this.toGoal.firstHop(map, view, cell, heading);
    if (!hop) {
      this.toGoal.fillUntil(map, view, this.tracker.briefing.goal, cell);
      hop = this.toGoal.nextHop(map, view, cell, heading);
    }
    this.onRoute = hop !== null;
    if (!hop) return this.tracker.turn(Turn.Right); // the goal is walled in
    this.expectedCell = hop.cellAfter(cell);
    this.expectedHeading = hop.headingAfter(heading);
    return this.tracker.go(hop.heading, hop.cells);
  }
}
