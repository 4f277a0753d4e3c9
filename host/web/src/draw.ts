// Draws a maze with a robot on a canvas. A canvas and not SVG, because a maze of 64 x 64 cells has
// more than 8,000 walls and numbers, and all of it may change with every step.

import type { About, Frame } from "./core";
import type { Notebook } from "./journal";
import { visible } from "./text";
import { PAINT, type Theme } from "./theme";

export const OVERLAYS = [
  { key: "known", digit: "1", title: "Known walls", hint: "What the readings so far have shown; the rest is in fog" },
  { key: "maze", digit: "2", title: "True maze", hint: "All walls, known or not" },
  { key: "path", digit: "3", title: "Optimistic path", hint: "The best path if no unknown wall is there" },
  { key: "trail", digit: "4", title: "Trail", hint: "Where the steps of this run ended" },
  { key: "heat", digit: "5", title: "Visits", hint: "How often the robot was in each cell" },
  { key: "distances", digit: "6", title: "Distances", hint: "Steps to the goal by the optimistic path" },
  { key: "beams", digit: "7", title: "Readings", hint: "How far the robot sees to its left, ahead and to its right" },
  { key: "paint", digit: "8", title: "Paint and labels", hint: "What the robot wrote into cells; replay files have it" },
  { key: "beliefs", digit: "9", title: "Robot's walls", hint: "What the robot says about walls; wrong in red" },
] as const;

export type OverlayKey = (typeof OVERLAYS)[number]["key"];

export type Overlays = ReadonlySet<OverlayKey>;

/** Where the robot is drawn, in cells; the angle in quarter turns clockwise from up. */
export interface Pose {
  x: number;
  y: number;
  angle: number;
}

export interface Scene {
  about: About;
  frame: Frame;
  notebook: Notebook;
  pose: Pose;
  overlays: Overlays;
  theme: Theme;
}

const DX = [0, 1, 0, -1];
const DY = [1, 0, -1, 0];

/** Draws a scene on the whole of a square canvas. */
export function draw(context: CanvasRenderingContext2D, scene: Scene): void {
  const side = context.canvas.width;
  const n = scene.about.dimension;
  const unit = side / (n + 0.5);
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.clearRect(0, 0, side, side);
  // From here on in cells: x to the right, y down from the top.
  context.setTransform(unit, 0, 0, unit, unit / 4, unit / 4);
  const painter = new Painter(context, scene, unit);
  painter.ground();
  painter.heat();
  painter.paint();
  painter.fog();
  painter.path();
  painter.trail();
  painter.walls();
  painter.beliefs();
  painter.numbers();
  painter.beams();
  painter.robot();
}

class Painter {
  readonly #context: CanvasRenderingContext2D;
  readonly #scene: Scene;
  readonly #n: number;
  readonly #unit: number;

  constructor(context: CanvasRenderingContext2D, scene: Scene, unit: number) {
    this.#context = context;
    this.#scene = scene;
    this.#n = scene.about.dimension;
    this.#unit = unit;
  }

  #has(key: OverlayKey): boolean {
    return this.#scene.overlays.has(key);
  }

  /** A length of so many pixels at least, and of that part of a cell. */
  #width(cells: number, pixels: number): number {
    return Math.max(cells, (pixels * devicePixelRatio) / this.#unit);
  }

  #top(y: number): number {
    return this.#n - 1 - y;
  }

  #each(visit: (x: number, y: number, index: number) => void): void {
    for (let x = 0; x < this.#n; x += 1) {
      for (let y = 0; y < this.#n; y += 1) {
        visit(x, y, x * this.#n + y);
      }
    }
  }

  ground(): void {
    const { about, theme } = this.#scene;
    const context = this.#context;
    context.fillStyle = theme.cell;
    context.fillRect(0, 0, this.#n, this.#n);
    const [x, y, width, height] = about.goal;
    context.fillStyle = theme.goal;
    context.fillRect(x, this.#n - y - height, width, height);
    context.fillStyle = theme.start;
    context.fillRect(about.start[0], this.#top(about.start[1]), 1, 1);
  }

  heat(): void {
    if (!this.#has("heat")) {
      return;
    }
    const { frame, theme } = this.#scene;
    const most = frame.visits.reduce((most, it) => Math.max(most, it), 1);
    this.#context.fillStyle = theme.heat;
    this.#each((x, y, index) => {
      const visits = frame.visits[index] ?? 0;
      if (visits > 0) {
        this.#context.globalAlpha = 0.12 + 0.6 * Math.sqrt(visits / most);
        this.#context.fillRect(x, this.#top(y), 1, 1);
      }
    });
    this.#context.globalAlpha = 1;
  }

  paint(): void {
    if (!this.#has("paint")) {
      return;
    }
    const n = this.#n;
    this.#context.globalAlpha = 0.45;
    for (const [index, color] of this.#scene.notebook.paint) {
      this.#context.fillStyle = PAINT[color] ?? "transparent";
      this.#context.fillRect(Math.floor(index / n) + 0.08, this.#top(index % n) + 0.08, 0.84, 0.84);
    }
    this.#context.globalAlpha = 1;
  }

  /** The more of a cell's walls are unknown, the denser. */
  fog(): void {
    if (!this.#has("known")) {
      return;
    }
    const { frame, theme } = this.#scene;
    this.#context.fillStyle = theme.fog;
    this.#each((x, y, index) => {
      const sides = frame.beliefs[index] ?? 0;
      let unknown = 0;
      for (let side = 0; side < 4; side += 1) {
        unknown += (sides >> (2 * side)) & 3 ? 0 : 1;
      }
      if (unknown > 0) {
        this.#context.globalAlpha = [0, 0.3, 0.5, 0.75, 1][unknown] ?? 1;
        this.#context.fillRect(x, this.#top(y), 1, 1);
      }
    });
    this.#context.globalAlpha = 1;
  }

  #line(cells: ArrayLike<number>): void {
    const context = this.#context;
    context.beginPath();
    for (let at = 0; at + 1 < cells.length; at += 2) {
      const [x, y] = [(cells[at] ?? 0) + 0.5, this.#top(cells[at + 1] ?? 0) + 0.5];
      if (at === 0) {
        context.moveTo(x, y);
      } else {
        context.lineTo(x, y);
      }
    }
    context.stroke();
  }

  path(): void {
    if (!this.#has("path")) {
      return;
    }
    const context = this.#context;
    context.save();
    context.strokeStyle = this.#scene.theme.path;
    context.lineWidth = this.#width(0.34, 3);
    context.lineJoin = context.lineCap = "round";
    context.globalAlpha = 0.55;
    this.#line(this.#scene.frame.path);
    context.restore();
  }

  trail(): void {
    if (!this.#has("trail")) {
      return;
    }
    const { frame, theme, pose } = this.#scene;
    const context = this.#context;
    context.save();
    context.strokeStyle = context.fillStyle = frame.run === 1 ? theme.exploration : theme.speed;
    context.lineWidth = this.#width(0.09, 1.5);
    context.lineJoin = context.lineCap = "round";
    context.globalAlpha = frame.run === 1 ? 0.6 : 1;
    // The robot may be on its way to the next stop.
    this.#line([...frame.stops, pose.x, pose.y]);
    const radius = this.#width(0.09, 1.5);
    context.beginPath();
    for (let at = 0; at + 1 < frame.stops.length; at += 2) {
      const [x, y] = [(frame.stops[at] ?? 0) + 0.5, this.#top(frame.stops[at + 1] ?? 0) + 0.5];
      context.moveTo(x + radius, y);
      context.arc(x, y, radius, 0, 2 * Math.PI);
    }
    context.fill();
    context.restore();
  }

  /** Adds a side of a cell to the current path. */
  #edge(x: number, y: number, side: number): void {
    const top = this.#top(y);
    const [ax, ay, bx, by] = (
      [
        [x, top, x + 1, top],
        [x + 1, top, x + 1, top + 1],
        [x, top + 1, x + 1, top + 1],
        [x, top, x, top + 1],
      ] as const
    )[side] ?? [0, 0, 0, 0];
    this.#context.moveTo(ax, ay);
    this.#context.lineTo(bx, by);
  }

  /** Strokes all walls of which `is` says so; each is asked for once. */
  #edges(is: (index: number, side: number, x: number, y: number) => boolean): void {
    this.#context.beginPath();
    this.#each((x, y, index) => {
      for (let side = 0; side < 4; side += 1) {
        const isOther = (side === 2 && y > 0) || (side === 3 && x > 0);
        if (!isOther && is(index, side, x, y)) {
          this.#edge(x, y, side);
        }
      }
    });
    this.#context.stroke();
  }

  walls(): void {
    const { about, frame, theme } = this.#scene;
    const [maze, known] = [this.#has("maze"), this.#has("known")];
    const context = this.#context;
    const isThere = (index: number, side: number) => !((about.walls[index] ?? 0) & (1 << side));
    const belief = (index: number, side: number) => ((frame.beliefs[index] ?? 0) >> (2 * side)) & 3;
    context.save();
    context.lineCap = "round";
    if (maze && known) {
      context.strokeStyle = theme.faint;
      context.lineWidth = this.#width(0.06, 1);
      this.#edges((index, side) => isThere(index, side) && belief(index, side) === 0);
    }
    context.strokeStyle = theme.wall;
    context.lineWidth = this.#width(0.11, 1.5);
    if (known) {
      this.#edges((index, side) => belief(index, side) === 2);
    } else if (maze) {
      this.#edges(isThere);
    } else {
      context.strokeRect(0, 0, this.#n, this.#n);
    }
    context.restore();
  }

  /** The robot's beliefs about walls: closed ones as lines, and everything that is wrong in red. */
  beliefs(): void {
    if (!this.#has("beliefs")) {
      return;
    }
    const { about, notebook, theme } = this.#scene;
    const context = this.#context;
    const n = this.#n;
    context.save();
    context.lineCap = "round";
    context.lineWidth = this.#width(0.08, 1.5);
    for (const wrong of [false, true]) {
      context.strokeStyle = wrong ? theme.wrong : theme.belief;
      context.setLineDash(wrong ? [0.12, 0.16] : []);
      context.beginPath();
      for (const [key, belief] of notebook.walls) {
        const [index, side] = [key >> 2, key & 3];
        const isOpen = ((about.walls[index] ?? 0) & (1 << side)) !== 0;
        const isWrong = belief !== 0 && (belief === 1) !== isOpen;
        if (isWrong === wrong && (wrong || belief === 2)) {
          this.#edge(Math.floor(index / n), index % n, side);
        }
      }
      context.stroke();
    }
    context.restore();
  }

  numbers(): void {
    const { frame, notebook, theme } = this.#scene;
    const context = this.#context;
    context.textAlign = "center";
    context.textBaseline = "middle";
    if (this.#has("distances") && this.#unit >= 9 * devicePixelRatio) {
      context.fillStyle = theme.text;
      context.globalAlpha = 0.75;
      context.font = "0.4px system-ui, sans-serif";
      this.#each((x, y, index) => {
        const distance = frame.distances[index] ?? -1;
        if (distance >= 0) {
          context.fillText(String(distance), x + 0.5, this.#top(y) + 0.54);
        }
      });
      context.globalAlpha = 1;
    }
    if (this.#has("paint")) {
      context.fillStyle = theme.text;
      const place = this.#has("distances") ? 0.24 : 0.54;
      for (const [index, label] of notebook.labels) {
        const shown = visible(label, 8);
        context.font = `${Math.min(0.44, 1.5 / Math.max(shown.length, 1))}px system-ui, sans-serif`;
        const [x, y] = [Math.floor(index / this.#n), index % this.#n];
        context.fillText(shown, x + 0.5, this.#top(y) + place, 0.92);
      }
    }
  }

  beams(): void {
    if (!this.#has("beams")) {
      return;
    }
    const { frame, pose, theme } = this.#scene;
    const context = this.#context;
    const angle = Math.round(pose.angle);
    if (Math.abs(pose.angle - angle) > 0.01 || pose.x !== frame.x || pose.y !== frame.y) {
      return;
    }
    context.save();
    context.strokeStyle = theme.beam;
    context.lineWidth = this.#width(0.07, 1.5);
    context.setLineDash([0.14, 0.14]);
    context.beginPath();
    frame.sensors.forEach((reach, index) => {
      const side = (((angle + index - 1) % 4) + 4) % 4;
      const [x, y] = [pose.x + 0.5, this.#top(pose.y) + 0.5];
      context.moveTo(x, y);
      context.lineTo(x + (DX[side] ?? 0) * (reach + 0.42), y - (DY[side] ?? 0) * (reach + 0.42));
    });
    context.stroke();
    context.restore();
  }

  /** A mouse from above: the nose shows where it heads. */
  robot(): void {
    const { pose, theme } = this.#scene;
    const context = this.#context;
    context.save();
    context.translate(pose.x + 0.5, this.#top(pose.y) + 0.5);
    context.rotate((pose.angle * Math.PI) / 2);
    const scale = this.#width(1, 11);
    context.scale(scale, scale);
    context.lineJoin = "round";
    context.lineWidth = 0.07;
    context.strokeStyle = theme.robotEdge;
    context.fillStyle = theme.robot;
    context.beginPath();
    context.moveTo(0, -0.38);
    context.bezierCurveTo(0.3, -0.2, 0.32, 0.3, 0, 0.3);
    context.bezierCurveTo(-0.32, 0.3, -0.3, -0.2, 0, -0.38);
    context.closePath();
    context.stroke();
    context.fill();
    context.beginPath();
    for (const side of [-1, 1]) {
      context.moveTo(side * 0.13 + 0.085, -0.06);
      context.arc(side * 0.13, -0.06, 0.085, 0, 2 * Math.PI);
    }
    context.fillStyle = theme.robotEdge;
    context.fill();
    context.restore();
  }
}
