// Everything there is to know at a step, as a table with a column for each match.

import type { ComponentChildren } from "preact";
import type { Pane, Player } from "./player";
import { visible } from "./text";
import { atReset, heading, outcome, outlook, step } from "./words";

const ROWS: [title: string, value: (pane: Pane) => ComponentChildren][] = [
  ["Position", ({ frame }) => `(${frame.x}, ${frame.y}), facing ${heading(frame.heading)}`],
  ["Readings", ({ frame: { sensors } }) => `left ${sensors[0]}, front ${sensors[1]}, right ${sensors[2]}`],
  ["Last step", ({ frame }) => step(frame.done)],
  ["Next step", ({ frame }) => step(frame.next)],
  ["Steps", ({ frame }) => `${frame.explorationSteps} exploration, ${frame.speedSteps} speed run`],
  ["Best path", ({ frame }) => outlook(frame.optimistic, frame.pessimistic)],
  ["Unknown walls", ({ frame }) => (frame.newWalls > 0 ? `${frame.unknownWalls} (${frame.newWalls} just seen)` : frame.unknownWalls)],
  ["At the reset", ({ match }) => atReset(match.about)],
  ["Steps without news", ({ match }) => match.about.idleSteps],
  [
    "Regret",
    ({ match: { about } }) => (about.regret === null ? "–" : `${about.regret[0]} exploration, ${about.regret[1]} speed run`),
  ],
  ["Outcome", ({ match }) => visible(outcome(match.about))],
];

export function Facts({ player }: { player: Player }) {
  const { panes } = player;
  const hasFalse = panes.some((pane) => pane.match.about.contradictions > 0);
  return (
    <div class="w-scroll" tabIndex={0} role="group" aria-label="Facts">
      <table class="w-facts">
        {panes.length > 1 && (
          <thead>
            <tr>
              <td />
              {panes.map((pane, index) => (
                <th key={index} scope="col">
                  {visible(pane.source.robot, 60)}
                </th>
              ))}
            </tr>
          </thead>
        )}
        <tbody>
          {ROWS.map(([title, value]) => (
            <tr key={title}>
              <th scope="row">{title}</th>
              {panes.map((pane, index) => (
                <td key={index}>{value(pane)}</td>
              ))}
            </tr>
          ))}
          {hasFalse && (
            <tr>
              <th scope="row">False beliefs</th>
              {panes.map((pane, index) => (
                <td key={index}>{pane.match.about.contradictions}</td>
              ))}
            </tr>
          )}
        </tbody>
      </table>
    </div>
  );
}

/** What robots have logged, if a replay file has it. */
export function Logs({ player }: { player: Player }) {
  const panes = player.panes.filter((pane) => pane.match.about.notes.length > 0);
  if (panes.length === 0) {
    return null;
  }
  return (
    <details class="w-details" open>
      <summary>Robot's log</summary>
      {panes.map((pane, index) => (
        <ol key={index} class="w-logs">
          {pane.notebook.logs.map((it, at) => (
            <li key={at} class={`w-log-${it.level}`}>
              <span class="w-note">
                {it.step}
                {it.level === "info" ? "" : ` ${it.level}`}
              </span>{" "}
              {visible(it.text, 500)}
            </li>
          ))}
          {pane.match.about.notesLeftOut > 0 && <li class="w-note">{pane.match.about.notesLeftOut} notes were left out.</li>}
        </ol>
      ))}
    </details>
  );
}
