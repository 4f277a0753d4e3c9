// The matches that can be watched: those of the page, and those of replay files.

import type { About, Core, Match } from "./core";
import type { PageData } from "./data";
import type { Place } from "./link";

/** A match that can be opened. Names are untrusted. */
export interface Source {
  robot: string;
  maze: string;
  seed: string;
  /** The same for matches in equal mazes. */
  mazeKey: string;
  /** Where it comes from, if that is a file. */
  file: string | null;
  open(core: Core): Match;
}

/** The files and the page's matches, by place. */
export class Library {
  readonly data: PageData;
  readonly files: Source[] = [];
  readonly #sources: (Source | undefined)[] = [];
  readonly #byPlace = new Map<string, number>();
  readonly #byMaze = new Map<number, number[]>();
  readonly #keys = new Map<number, string>();

  constructor(data: PageData) {
    this.data = data;
    data.matches.forEach((it, index) => {
      const place = this.#placeKey(
        data.robots[it.robot] ?? "",
        data.mazes[it.maze]?.name ?? "",
        data.seeds[it.seed] ?? "",
      );
      if (!this.#byPlace.has(place)) {
        this.#byPlace.set(place, index);
      }
      const inMaze = this.#byMaze.get(it.maze);
      if (inMaze) {
        inMaze.push(index);
      } else {
        this.#byMaze.set(it.maze, [index]);
      }
    });
  }

  /** The page's match with that index. */
  source(index: number): Source | null {
    const known = this.#sources[index];
    const match = this.data.matches[index];
    if (known || !match) {
      return known ?? null;
    }
    const { data } = this;
    const source: Source = {
      robot: data.robots[match.robot] ?? "",
      maze: data.mazes[match.maze]?.name ?? "",
      seed: data.seeds[match.seed] ?? "",
      mazeKey: this.#mazeKey(match.maze),
      file: null,
      open: (core) => {
        const identity = data.mazes[match.maze]?.identity ?? new Uint8Array();
        return core.openMatch(data.rules, identity, match.transcript);
      },
    };
    this.#sources[index] = source;
    return source;
  }

  /** The match of a link. Files come first: they were opened last. */
  find(place: Place): Source | null {
    const is = (it: Source) =>
      it.robot === place.robot && it.maze === place.maze && it.seed === place.seed;
    const file = this.files.find(is);
    const index = this.#byPlace.get(this.#placeKey(place.robot, place.maze, place.seed));
    return file ?? (index === undefined ? null : this.source(index));
  }

  /** All matches in the same maze, of files too. */
  inMazeOf(source: Source): Source[] {
    const found = this.files.filter((it) => it.mazeKey === source.mazeKey);
    for (const [maze, indices] of this.#byMaze) {
      if (this.#mazeKey(maze) === source.mazeKey) {
        found.push(...indices.map((index) => this.source(index)).filter((it) => it !== null));
      }
    }
    return found;
  }

  /** Opens a replay file; throws what the core says about a damaged one. */
  add(core: Core, name: string, bytes: Uint8Array): Source {
    const match = core.openReplay(bytes);
    const { about } = match;
    match.close();
    const origin = about.origin ?? { robot: name, maze: "", seed: "" };
    const source: Source = {
      robot: origin.robot,
      maze: origin.maze,
      seed: origin.seed,
      mazeKey: keyOf(about),
      file: name,
      open: (core) => core.openReplay(bytes),
    };
    const isSame = (it: Source) =>
      it.robot === source.robot && it.maze === source.maze && it.seed === source.seed;
    const before = this.files.findIndex(isSame);
    if (before >= 0) {
      this.files.splice(before, 1);
    }
    this.files.unshift(source);
    return source;
  }

  #mazeKey(maze: number): string {
    const known = this.#keys.get(maze);
    if (known !== undefined) {
      return known;
    }
    const key = [...(this.data.mazes[maze]?.identity ?? [])].join();
    this.#keys.set(maze, key);
    return key;
  }

  #placeKey(robot: string, maze: string, seed: string): string {
    return JSON.stringify([robot, maze, seed]);
  }
}

/** The identity bytes of the maze, as text. */
function keyOf(about: About): string {
  return [about.dimension, ...about.start, ...about.goal, ...about.walls].join();
}
