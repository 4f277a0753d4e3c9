// Sentences about a match. All of them end up as text, never as HTML.

import type { About, Frame, StepDone } from "./core";

const HEADINGS = ["up", "right", "down", "left"];
const TURNS = ["turn left", "straight", "turn right"];

export function heading(it: number): string {
  return HEADINGS[it] ?? "?";
}

export function steps(count: number): string {
  return count === 1 ? "1 step" : `${count} steps`;
}

/** Where the match is, for people who watch it. */
export function status(about: About, frame: Frame): string {
  const parts = [`Step ${frame.position} of ${about.last}`];
  if (frame.position === about.last) {
    parts.push(about.score === null ? about.verdict : `finished, score ${about.score}`);
  } else {
    parts.push(frame.run === 1 ? "exploration run" : "speed run");
  }
  const certain = about.certainAt;
  if (certain !== null && certain <= frame.position) {
    return `${parts.join(", ")}; best path certain since step ${certain}`;
  }
  return `${parts.join(", ")}; ${outlook(frame.optimistic, frame.pessimistic)}`;
}

/** What is known about the best speed run. */
export function outlook(optimistic: number, pessimistic: number): string {
  if (optimistic < 0) {
    return "goal known to be unreachable";
  }
  if (pessimistic < 0) {
    return `no path known yet, at least ${steps(optimistic)}`;
  }
  if (optimistic === pessimistic) {
    return `best path certain: ${steps(optimistic)}`;
  }
  return `best path known ${steps(pessimistic)}, at least ${optimistic}`;
}

export function step(it: StepDone | null): string {
  if (it === null) {
    return "none";
  }
  if (it.isReset) {
    return it.event === 4 ? "reset" : "reset, ignored";
  }
  const direction = it.advance < 0 ? "back" : "ahead";
  const moved = it.advance === 0 ? "stay" : `${Math.abs(it.advance)} ${direction}`;
  const notes: string[] = [];
  if (it.event & 1) {
    notes.push(`bumped after ${it.cells}`);
  }
  if (it.event & 2) {
    notes.push(`clamped to ${it.cells}`);
  }
  return [`${TURNS[it.turn] ?? "?"}, ${moved}`, ...notes].join("; ");
}

/** Whether the optimal path was proven when the robot started its speed run. */
export function atReset(about: About): string {
  if (about.atReset === null) {
    return "no reset";
  }
  const [optimistic, pessimistic] = about.atReset;
  if (optimistic === null || pessimistic === null) {
    return "no path was known";
  }
  const saving = pessimistic - optimistic;
  return saving === 0 ? "proven optimal" : `${steps(saving)} might still be saved`;
}

export function outcome(about: About): string {
  if (about.score !== null) {
    const oracle = about.oracleScore === null ? "" : `; oracle ${about.oracleScore}`;
    return `score ${about.score} (${about.explorationSteps} + ${about.speedSteps} steps${oracle})`;
  }
  return about.fault ? `${about.verdict}: ${about.fault}` : about.verdict;
}
