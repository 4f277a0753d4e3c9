// The buttons below the drawing.

import { OVERLAYS } from "./draw";
import { IconButton } from "./icons";
import type { Library } from "./library";
import { nameOf } from "./pane";
import { PANES_MAX, type Player, SPEEDS } from "./player";

export function Transport({ player }: { player: Player }) {
  const { isPlaying } = player;
  return (
    <div class="w-transport" role="group" aria-label="Playback">
      <IconButton icon="first" label="To the start" shortcut="Home" onClick={() => player.seek(0)} />
      <IconButton icon="previous" label="Previous event" shortcut="[" onClick={() => player.jump(-1)} />
      <IconButton
        icon="back"
        label="Step back"
        shortcut="Left"
        onClick={() => {
          player.pause();
          player.seek(player.position - 1);
        }}
      />
      <IconButton
        icon={isPlaying ? "pause" : "play"}
        label={isPlaying ? "Pause" : "Play"}
        shortcut="Space"
        class="w-primary"
        autofocus
        onClick={() => player.toggle()}
      />
      <IconButton
        icon="forward"
        label="Step forward"
        shortcut="Right"
        onClick={() => {
          player.pause();
          player.seek(player.position + 1);
        }}
      />
      <IconButton icon="next" label="Next event" shortcut="]" onClick={() => player.jump(1)} />
      <IconButton icon="last" label="To the end" shortcut="End" onClick={() => player.seek(player.last)} />
      <label class="w-select w-speed">
        <span class="w-hidden">Steps per second</span>
        <select value={player.speed} title="Steps per second (+ and -)" onChange={(event) => player.setSpeed(Number(event.currentTarget.value))}>
          {SPEEDS.map((it) => (
            <option key={it} value={it}>
              {it}/s
            </option>
          ))}
        </select>
      </label>
    </div>
  );
}

export function OverlayChoice({ player }: { player: Player }) {
  const hasNotes = player.panes.some((pane) => pane.match.about.notes.length > 0);
  const shown = OVERLAYS.filter((it) => hasNotes || (it.key !== "paint" && it.key !== "beliefs"));
  return (
    <fieldset class="w-overlays">
      <legend>Show</legend>
      {shown.map(({ key, title, hint, digit }) => (
        <label key={key} title={hint}>
          <input type="checkbox" checked={player.overlays.has(key)} onChange={() => player.toggleOverlay(key)} />
          <span>{title}</span> <kbd aria-hidden="true">{digit}</kbd>
        </label>
      ))}
    </fieldset>
  );
}

export function Compare({ player, library }: { player: Player; library: Library }) {
  const first = player.panes[0];
  if (!first || player.panes.length >= PANES_MAX) {
    return null;
  }
  const shown = player.panes.map((pane) => pane.source);
  const others = library.inMazeOf(first.source).filter((it) => !shown.includes(it));
  if (others.length === 0) {
    return null;
  }
  return (
    <label class="w-select">
      <span>Compare with</span>
      <select
        value=""
        onChange={(event) => {
          const chosen = others[Number(event.currentTarget.value)];
          event.currentTarget.value = "";
          if (chosen) {
            player.add(chosen);
          }
        }}
      >
        <option value="">choose a match…</option>
        {others.map((it, at) => (
          <option key={at} value={at}>
            {nameOf(it, [...others, first.source])}
          </option>
        ))}
      </select>
    </label>
  );
}

const KEYS: [keys: string[], meaning: string][] = [
  [["Space"], "play or pause"],
  [["←", "→"], "a step back or forward; with Shift ten steps"],
  [["[", "]"], "to the previous or next event"],
  [["Home", "End"], "to the start or end"],
  [["+", "-"], "faster or slower"],
  [["1", "…", "9"], "overlays"],
  [["Esc"], "close the player"],
];

export function KeyHelp() {
  return (
    <details class="w-details">
      <summary>Keyboard</summary>
      <dl class="w-keys">
        {KEYS.map(([keys, meaning]) => (
          <div key={meaning}>
            <dt>
              {keys.map((it) => (
                <kbd key={it}>{it}</kbd>
              ))}
            </dt>
            <dd>{meaning}</dd>
          </div>
        ))}
      </dl>
    </details>
  );
}
