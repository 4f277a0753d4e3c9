// The timeline: a slider, and above it a lane for each match with its milestones.

import type { Pane, Player } from "./player";
import { visible } from "./text";
import { steps } from "./words";

/** Signs of milestones, so that none is told by its colour alone. */
const SIGNS: Record<string, { sign: string; kind: string }> = {
  "best path certain": { sign: "◆", kind: "certain" },
  "goal reached": { sign: "⚑", kind: "goal" },
  reset: { sign: "↺", kind: "reset" },
};

/** Milestones with a sign, and ticks; more than these are not told apart on a screen. */
const TICKS_MAX = 400;

const LISTED_MAX = 200;

export function Timeline({ player }: { player: Player }) {
  const { last, position, panes } = player;
  const run = panes[0]?.frame.run === 2 ? "speed run" : "exploration run";
  return (
    <div class="w-timeline">
      <div class="w-lanes" aria-hidden="true">
        {panes.map((pane, index) => (
          <Lane key={index} pane={pane} index={index} last={last} />
        ))}
      </div>
      <input
        type="range"
        class="w-slider"
        min={0}
        max={last}
        step={1}
        value={position}
        aria-label="Step"
        aria-valuetext={`step ${position} of ${last}, ${run}`}
        onInput={(event) => player.seek(Number(event.currentTarget.value))}
      />
    </div>
  );
}

function Lane({ pane, index, last }: { pane: Pane; index: number; last: number }) {
  const { about, audit } = pane.match;
  const place = (position: number) => `${(100 * position) / Math.max(last, 1)}%`;
  const marks = about.milestones.filter((it) => it[1] in SIGNS);
  const ticks = about.milestones.filter((it) => !(it[1] in SIGNS) && it[1] !== "end");
  return (
    <div class={`w-lane w-lane-${index}`}>
      <Outlook audit={audit} end={about.last} last={last} certainAt={about.certainAt} />
      {ticks.slice(0, TICKS_MAX).map(([position, name], at) => (
        <i key={`t${at}`} class={`w-tick w-tick-${name === "bump" ? "bump" : "other"}`} style={{ left: place(position) }} />
      ))}
      {marks.map(([position, name]) => (
        <b key={name} class={`w-mark w-mark-${SIGNS[name]?.kind ?? ""}`} style={{ left: place(position) }} title={`${name}: step ${position}`}>
          {SIGNS[name]?.sign}
        </b>
      ))}
    </div>
  );
}

/** How far the best known path and the best possible one are apart at each step. */
function Outlook(props: { audit: Int32Array; end: number; last: number; certainAt: number | null }) {
  const { audit, end, last, certainAt } = props;
  let most = 1;
  for (let at = 0; at <= end; at += 1) {
    most = Math.max(most, audit[3 * at + 1] ?? 0, audit[3 * at + 2] ?? 0);
  }
  const height = (value: number) => 100 - (92 * Math.min(value, most)) / most;
  const upper: string[] = [];
  const lower: string[] = [];
  let before = "";
  for (let at = 0; at <= end; at += 1) {
    const [optimistic, pessimistic] = [audit[3 * at + 1] ?? -1, audit[3 * at + 2] ?? -1];
    const values = `${optimistic},${pessimistic}`;
    // A step down is vertical; what stays the same needs no point.
    if (values !== before || at === end) {
      const [top, bottom] = [pessimistic < 0 ? 0 : height(pessimistic), height(Math.max(optimistic, 0))];
      const previous = upper.at(-1)?.split(" ")[1];
      if (previous !== undefined) {
        upper.push(`${at} ${previous}`);
        lower.push(`${at} ${lower.at(-1)?.split(" ")[1] ?? bottom}`);
      }
      upper.push(`${at} ${top}`);
      lower.push(`${at} ${bottom}`);
      before = values;
    }
  }
  return (
    <svg class="w-outlook" viewBox={`0 0 ${Math.max(last, 1)} 100`} preserveAspectRatio="none" focusable="false">
      <polygon class="w-outlook-gap" points={[...upper, ...lower.reverse()].join(" ")} />
      {certainAt !== null && (
        <rect class="w-outlook-certain" x={certainAt} y={96} width={Math.max(end - certainAt, 0)} height={4} />
      )}
    </svg>
  );
}

/** The milestones as a list of buttons: for keyboards and screen readers, and to read on paper. */
export function Events({ player }: { player: Player }) {
  const events = player.panes
    .flatMap((pane, index) => pane.match.about.milestones.map(([position, name]) => ({ pane, index, position, name })))
    .sort((a, b) => a.position - b.position || a.index - b.index);
  const many = player.panes.length > 1;
  return (
    <details class="w-details">
      <summary>Events ({events.length})</summary>
      <ol class="w-events">
        {events.slice(0, LISTED_MAX).map((it, at) => (
          <li key={at}>
            <button type="button" class="w-link" onClick={() => player.seek(it.position)}>
              Step {it.position}: {it.name}
              {many ? `, ${visible(it.pane.source.robot, 60)}` : ""}
            </button>
          </li>
        ))}
      </ol>
      {events.length > LISTED_MAX && <p>The first {LISTED_MAX} are listed.</p>}
      <p class="w-note">
        In the timeline: ⚑ goal reached, ↺ reset, ◆ best path certain; short ticks are bumps, clamped moves and ignored
        resets. The shade is the gap between the best known path and the best possible one: it closes when the path is
        certain. A speed run of {steps(player.panes[0]?.match.about.oracleSpeedSteps ?? 0)} is the optimum of this maze.
      </p>
    </details>
  );
}
