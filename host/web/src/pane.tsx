// One match: its name, its drawing and its state in a line.

import { useLayoutEffect, useRef } from "preact/hooks";
import { draw } from "./draw";
import type { Library, Source } from "./library";
import type { Pane as PaneState, Player } from "./player";
import { visible } from "./text";
import { themeOf } from "./theme";
import { heading, status } from "./words";

/** The name of a match in a list of those in its maze. */
export function nameOf(source: Source, all: Source[]): string {
  const hasSeeds = all.some((it) => it.seed !== source.seed);
  const seed = hasSeeds ? `, seed ${visible(source.seed, 30)}` : "";
  const file = source.file === null ? "" : ` (${visible(source.file, 60)})`;
  return `${visible(source.robot, 120)}${seed}${file}`;
}

export function Pane(props: { player: Player; library: Library; pane: PaneState; index: number }) {
  const { player, library, pane, index } = props;
  const { source, match, frame } = pane;
  const candidates = library.inMazeOf(source);
  const shown = candidates.includes(source) ? candidates : [source, ...candidates];
  const robot = visible(source.robot, 120);
  const many = player.panes.length > 1;
  return (
    <section class="w-pane" aria-label={`Match of ${robot}`}>
      <div class="w-pane-head">
        <span class={`w-swatch w-swatch-${index}`} aria-hidden="true" />
        <label class="w-select">
          <span class="w-hidden">{many ? `Match ${index + 1}` : "Match"}</span>
          <select
            value={shown.indexOf(source)}
            onChange={(event) => {
              const chosen = shown[Number(event.currentTarget.value)];
              if (chosen) {
                player.replace(index, chosen);
              }
            }}
          >
            {shown.map((it, at) => (
              <option key={at} value={at}>
                {nameOf(it, shown)}
              </option>
            ))}
          </select>
        </label>
        {many && (
          <button
            type="button"
            class="w-button w-small"
            aria-label={`Remove ${robot}`}
            title="Remove"
            onClick={() => player.remove(index)}
          >
            <span aria-hidden="true">×</span>
          </button>
        )}
      </div>
      <Drawing
        player={player}
        pane={pane}
        label={`${robot} at (${frame.x}, ${frame.y}), facing ${heading(frame.heading)}, in ${visible(source.maze, 120)}`}
      />
      <p class="w-status">{status(match.about, frame)}</p>
    </section>
  );
}

function Drawing(props: { player: Player; pane: PaneState; label: string }) {
  const { player, pane, label } = props;
  const box = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  const current = useRef(pane);
  current.current = pane;

  useLayoutEffect(() => {
    const [element, parent] = [canvas.current, box.current];
    const context = element?.getContext("2d");
    if (!element || !parent || !context) {
      return;
    }
    let theme = themeOf(element);
    const paint = () => {
      const { match, frame, notebook } = current.current;
      const scene = {
        about: match.about,
        frame,
        notebook,
        pose: player.pose(current.current),
        overlays: player.overlays,
        theme,
      };
      draw(context, scene);
    };
    const resize = () => {
      const side = Math.max(120, Math.min(parent.clientWidth, parent.clientHeight));
      const pixels = Math.round(side * devicePixelRatio);
      element.style.width = element.style.height = `${side}px`;
      if (element.width !== pixels) {
        element.width = element.height = pixels;
      }
      paint();
    };
    const retheme = () => {
      theme = themeOf(element);
      paint();
    };
    const observer = new ResizeObserver(resize);
    observer.observe(parent);
    const schemes = ["(prefers-color-scheme: dark)", "print"].map((it) => matchMedia(it));
    for (const scheme of schemes) {
      scheme.addEventListener("change", retheme);
    }
    const stop = player.onDraw(paint);
    resize();
    return () => {
      stop();
      observer.disconnect();
      for (const scheme of schemes) {
        scheme.removeEventListener("change", retheme);
      }
    };
  }, [player]);
  // Another match in the same place is drawn as soon as it is there.
  useLayoutEffect(() => player.redraw(), [player, pane]);

  return (
    <div class="w-drawing" ref={box} onClick={() => player.toggle()}>
      <canvas ref={canvas} role="img" aria-label={label} />
    </div>
  );
}
