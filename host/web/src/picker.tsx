// The section of the page from which matches are opened: lists, and replay files.

import { useState } from "preact/hooks";
import type { Library, Source } from "./library";
import { visible } from "./text";

export function Picker(props: {
  library: Library;
  problem: string | null;
  onWatch: (source: Source) => void;
  onFiles: (files: File[]) => void;
}) {
  const { library, problem, onWatch, onFiles } = props;
  const { data } = library;
  const [maze, setMaze] = useState(() => data.matches[0]?.maze ?? 0);
  const [match, setMatch] = useState(0);
  const mazes = [...new Set(data.matches.map((it) => it.maze))].sort((a, b) => a - b);
  const inMaze = data.matches.map((it, index) => ({ ...it, index })).filter((it) => it.maze === maze);
  const hasSeeds = data.seeds.length > 1;
  const chosen = inMaze.some((it) => it.index === match) ? match : (inMaze[0]?.index ?? 0);
  return (
    <div class="w-picker">
      {data.matches.length > 0 && (
        <form
          class="w-choice"
          onSubmit={(event) => {
            event.preventDefault();
            const source = library.source(chosen);
            if (source) {
              onWatch(source);
            }
          }}
        >
          <label class="w-select">
            <span>Maze</span>
            <select value={maze} onChange={(event) => setMaze(Number(event.currentTarget.value))}>
              {mazes.map((it) => (
                <option key={it} value={it}>
                  {visible(data.mazes[it]?.name ?? "", 120)}
                </option>
              ))}
            </select>
          </label>
          <label class="w-select">
            <span>Robot</span>
            <select value={chosen} onChange={(event) => setMatch(Number(event.currentTarget.value))}>
              {inMaze.map((it) => (
                <option key={it.index} value={it.index}>
                  {visible(data.robots[it.robot] ?? "", 120)}
                  {hasSeeds ? `, seed ${visible(data.seeds[it.seed] ?? "", 30)}` : ""}
                </option>
              ))}
            </select>
          </label>
          <button type="submit" class="w-button w-primary">
            Watch
          </button>
        </form>
      )}
      <label class="w-file">
        <span>Open replay files, or drop them anywhere on the page</span>
        <input
          type="file"
          accept=".json,application/json"
          multiple
          onChange={(event) => {
            onFiles([...(event.currentTarget.files ?? [])]);
            event.currentTarget.value = "";
          }}
        />
      </label>
      <p class="w-problem" role="alert" hidden={problem === null}>
        {visible(problem ?? "")}
      </p>
    </div>
  );
}
