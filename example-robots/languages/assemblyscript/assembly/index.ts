// What the host calls. The robot is in robot.ts.

import { Area, cellAt } from "../wasmouse/geometry";
import "../wasmouse/journal"; // `abort`, see asconfig.json
import { Action, Briefing } from "../wasmouse/robot";
import { Robot } from "./robot";

let robot: Robot | null = null;

/** Called once, before the first step. */
export function start(
  dimension: i32,
  startX: i32, startY: i32,
  goalX: i32, goalY: i32, goalWidth: i32, goalHeight: i32,
  budget: i32, budgetScope: i32,
  longestMove: i32, unitsPerCell: i32, explorationDivisor: i32,
  seed: u64, variant: i32,
): void {
  const briefing = new Briefing();
  briefing.dimension = dimension;
  briefing.start = cellAt(startX, startY);
  briefing.goal = new Area(goalX, goalY, goalWidth, goalHeight);
  briefing.budget = budget;
  briefing.budgetIsEachRun = budgetScope == 1;
  briefing.longestMove = longestMove;
  briefing.unitsPerCell = unitsPerCell;
  briefing.explorationDivisor = explorationDivisor;
  briefing.seed = seed;
  briefing.variant = variant;
  robot = new Robot(briefing);
}

/** Called once per step with the open cells in three directions. */
export function next_move(left: i32, front: i32, right: i32): Action {
  return robot!.nextMove(left, front, right);
}
