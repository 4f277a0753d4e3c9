// The state of the player: which matches are shown, at which step, and how. Knows no HTML.

import type { Core, Frame, Match } from "./core";
import type { OverlayKey, Pose } from "./draw";
import { type Notebook, notebookAt } from "./journal";
import type { Source } from "./library";
import { status } from "./words";

export const PANES_MAX = 4;
export const SPEEDS = [1, 2, 5, 10, 20, 50, 100, 250];

/** Faster than this, the robot jumps from step to step. */
const TWEEN_MAX = 20;

/** What is said aloud while a match is played comes at most this often, in milliseconds. */
const ANNOUNCE_MS = 4000;

export interface Pane {
  source: Source;
  match: Match;
  frame: Frame;
  notebook: Notebook;
}

export class Player {
  panes: Pane[] = [];
  position = 0;
  isPlaying = false;
  speed = 10;
  overlays = new Set<OverlayKey>(["known", "maze", "path", "trail"]);
  /** What went wrong, if anything. */
  problem: string | null = null;
  /** For screen readers. */
  announcement = "";
  readonly #core: Core;
  readonly #listeners = new Set<() => void>();
  readonly #drawers = new Set<() => void>();
  readonly #reducedMotion = matchMedia("(prefers-reduced-motion: reduce)");
  /** Between this position and the next one. */
  #fraction = 0;
  #lastTick = 0;
  #announcedAt = 0;
  #announceTimer = 0;

  constructor(core: Core) {
    this.#core = core;
  }

  /** Calls `listener` after every change; returns how to stop that. */
  subscribe(listener: () => void): () => void {
    this.#listeners.add(listener);
    return () => this.#listeners.delete(listener);
  }

  /** The same for what has to be drawn, several times for each step. */
  onDraw(drawer: () => void): () => void {
    this.#drawers.add(drawer);
    return () => this.#drawers.delete(drawer);
  }

  get last(): number {
    return this.panes.reduce((last, pane) => Math.max(last, pane.match.about.last), 0);
  }

  /** Shows matches, which are in the same maze, at a position. */
  open(sources: Source[], position: number): void {
    this.#closePanes();
    this.isPlaying = false;
    this.problem = null;
    this.#fraction = 0;
    for (const source of sources.slice(0, PANES_MAX)) {
      this.#openPane(source, position);
    }
    this.seek(position);
  }

  add(source: Source): void {
    if (this.panes.length < PANES_MAX) {
      this.problem = null;
      this.#openPane(source, this.position);
      this.seek(this.position);
    }
  }

  replace(index: number, source: Source): void {
    const sources = this.panes.map((pane) => pane.source);
    sources[index] = source;
    this.open(sources, this.position);
  }

  remove(index: number): void {
    const [pane] = this.panes.splice(index, 1);
    pane?.match.close();
    this.seek(this.position);
  }

  close(): void {
    this.#closePanes();
    this.isPlaying = false;
    this.#changed();
  }

  #closePanes(): void {
    for (const pane of this.panes) {
      pane.match.close();
    }
    this.panes = [];
  }

  #openPane(source: Source, position: number): void {
    try {
      const match = source.open(this.#core);
      const at = Math.min(position, match.about.last);
      const frame = match.frame(at);
      const notebook = notebookAt(match.about.notes, match.about.dimension, at);
      this.panes.push({ source, match, frame, notebook });
    } catch (error) {
      this.problem = error instanceof Error ? error.message : String(error);
    }
  }

  /** Goes to a position and draws it at once. */
  seek(position: number): void {
    this.position = Math.max(0, Math.min(Math.round(position), this.last));
    this.#fraction = 0;
    this.#show();
    this.#announceSoon();
  }

  #show(): void {
    try {
      for (const pane of this.panes) {
        const { about } = pane.match;
        const at = Math.min(this.position, about.last);
        if (pane.frame.position !== at) {
          pane.frame = pane.match.frame(at);
          pane.notebook = notebookAt(about.notes, about.dimension, at);
        }
      }
    } catch (error) {
      this.problem = error instanceof Error ? error.message : String(error);
      this.isPlaying = false;
      this.panes = [];
    }
    this.redraw();
    this.#changed();
  }

  redraw(): void {
    for (const draw of this.#drawers) {
      draw();
    }
  }

  toggle(): void {
    if (this.isPlaying) {
      this.pause();
    } else {
      this.play();
    }
  }

  play(): void {
    if (this.panes.length === 0) {
      return;
    }
    if (this.position >= this.last) {
      this.seek(0);
    }
    this.isPlaying = true;
    this.#lastTick = performance.now();
    this.#changed();
    requestAnimationFrame(this.#tick);
  }

  pause(): void {
    this.isPlaying = false;
    this.seek(this.position);
  }

  readonly #tick = (): void => {
    if (!this.isPlaying) {
      return;
    }
    const now = performance.now();
    // A tab that was in the background does not jump.
    const elapsed = Math.min(now - this.#lastTick, 250);
    this.#lastTick = now;
    const ahead = this.#fraction + (elapsed / 1000) * this.speed;
    const whole = Math.floor(ahead);
    this.#fraction = ahead - whole;
    if (whole > 0) {
      this.position = Math.min(this.position + whole, this.last);
      if (this.position === this.last) {
        this.pause();
        return;
      }
      this.#show();
      if (now - this.#announcedAt > ANNOUNCE_MS) {
        this.#announce();
      }
    } else {
      this.redraw();
    }
    requestAnimationFrame(this.#tick);
  };

  setSpeed(speed: number): void {
    this.speed = speed;
    this.#changed();
  }

  /** One speed up or down. */
  shiftSpeed(by: number): void {
    const at = SPEEDS.indexOf(this.speed) + by;
    this.setSpeed(SPEEDS[Math.max(0, Math.min(at, SPEEDS.length - 1))] ?? this.speed);
  }

  toggleOverlay(key: OverlayKey): void {
    if (!this.overlays.delete(key)) {
      this.overlays.add(key);
    }
    this.redraw();
    this.#changed();
  }

  /** Goes to the next milestone of any match in a direction. */
  jump(direction: 1 | -1): void {
    const positions = this.panes.flatMap((pane) => pane.match.about.milestones.map((it) => it[0]));
    const ahead = positions.filter((it) => (it - this.position) * direction > 0);
    const end = direction > 0 ? this.last : 0;
    this.isPlaying = false;
    this.seek(ahead.reduce((best, it) => (Math.abs(it - this.position) < Math.abs(best - this.position) ? it : best), end));
  }

  /** Where a pane's robot is drawn. */
  pose(pane: Pane): Pose {
    const { poses, about } = pane.match;
    const at = Math.min(this.position, about.last);
    const read = (index: number) => {
      const from = 4 * index;
      return { run: poses[from] ?? 1, x: poses[from + 1] ?? 0, y: poses[from + 2] ?? 0, angle: poses[from + 3] ?? 0 };
    };
    const from = read(at);
    const isMoving = this.isPlaying && this.speed <= TWEEN_MAX && !this.#reducedMotion.matches;
    if (!isMoving || at >= about.last) {
      return from;
    }
    const to = read(at + 1);
    if (from.run !== to.run) {
      return from;
    }
    const turn = ((to.angle - from.angle + 6) % 4) - 2;
    const isTurning = turn !== 0;
    const isDriving = from.x !== to.x || from.y !== to.y;
    const turning = isTurning ? (isDriving ? 0.35 : 1) : 0;
    const turned = turning === 0 ? 1 : Math.min(this.#fraction / turning, 1);
    const driven = turning === 1 ? 0 : Math.max(0, (this.#fraction - turning) / (1 - turning));
    const ease = driven * driven * (3 - 2 * driven);
    return {
      x: from.x + (to.x - from.x) * ease,
      y: from.y + (to.y - from.y) * ease,
      angle: from.angle + turn * turned,
    };
  }

  #announceSoon(): void {
    clearTimeout(this.#announceTimer);
    this.#announceTimer = setTimeout(() => this.#announce(), 500);
  }

  #announce(): void {
    this.#announcedAt = performance.now();
    const parts = this.panes.map((pane) => {
      const says = status(pane.match.about, pane.frame);
      return this.panes.length > 1 ? `${pane.source.robot}: ${says}` : says;
    });
    this.announcement = parts.join(". ");
    this.#changed();
  }

  #changed(): void {
    for (const listener of this.#listeners) {
      listener();
    }
  }
}
