// The keyboard of the player.

import { OVERLAYS } from "./draw";
import type { Player } from "./player";

/** Handles a key; returns whether the key means something. */
export function handleKey(player: Player, event: KeyboardEvent): boolean {
  if (event.ctrlKey || event.metaKey || event.altKey) {
    return false;
  }
  const target = event.target;
  // Lists and text fields need their keys themselves; buttons and boxes need the space bar, and the
  // slider goes by single steps on its own.
  if (target instanceof HTMLSelectElement || (target instanceof HTMLInputElement && target.type === "text")) {
    return false;
  }
  const isControl = target instanceof HTMLButtonElement || target instanceof HTMLInputElement || target instanceof HTMLElement && target.tagName === "SUMMARY";
  const isSlider = target instanceof HTMLInputElement && target.type === "range";
  const by = (steps: number) => {
    player.isPlaying = false;
    player.seek(player.position + steps);
  };
  switch (event.key) {
    case " ":
      if (isControl && !isSlider) {
        return false;
      }
      player.toggle();
      return true;
    case "ArrowLeft":
      by(event.shiftKey ? -10 : -1);
      return true;
    case "ArrowRight":
      by(event.shiftKey ? 10 : 1);
      return true;
    case "Home":
      by(-player.position);
      return true;
    case "End":
      by(player.last);
      return true;
    case "[":
      player.jump(-1);
      return true;
    case "]":
      player.jump(1);
      return true;
    case "+":
    case "=":
      player.shiftSpeed(1);
      return true;
    case "-":
      player.shiftSpeed(-1);
      return true;
  }
  const overlay = OVERLAYS.find((it) => it.digit === event.key);
  if (overlay) {
    player.toggleOverlay(overlay.key);
  }
  return overlay !== undefined;
}
