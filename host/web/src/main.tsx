// Starts the player on the page: reads the page's data, makes links of its tables, and follows the
// address.

import { render } from "preact";
import { Core } from "./core";
import { inflate, NO_DATA, type PageData, readData } from "./data";
import { Dialog } from "./dialog";
import { Library, type Source } from "./library";
import { formatLink, parseLink } from "./link";
import { Picker } from "./picker";
import { PANES_MAX, Player } from "./player";
import { visible } from "./text";

/** As in the core: no replay is larger. */
const FILE_BYTES_MAX = 16 * 1024 * 1024;

/** The address follows the match when it has not moved for so long, in milliseconds. */
const ADDRESS_MS = 300;

function block(id: string): string | null {
  return document.getElementById(id)?.textContent ?? null;
}

async function load(): Promise<{ core: Core; data: PageData; problem: string | null }> {
  const core = await Core.load(await inflate(block("wasmouse-core") ?? ""));
  const index = block("wasmouse-index");
  if (index === null) {
    return { core, data: NO_DATA, problem: null };
  }
  try {
    const data = readData(index, await inflate(block("wasmouse-bytes") ?? ""));
    return { core, data, problem: null };
  } catch (error) {
    // Replay files can still be opened.
    return { core, data: NO_DATA, problem: `The matches of this page are damaged: ${messageOf(error)}` };
  }
}

function messageOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

class App {
  readonly #library: Library;
  readonly #core: Core;
  readonly #player: Player;
  readonly #picker: HTMLElement;
  #problem: string | null;
  #addressTimer = 0;
  /** The address without a step in it, to go back to. */
  readonly #home = location.href.split("#")[0] ?? "";

  constructor(core: Core, data: PageData, problem: string | null, picker: HTMLElement) {
    this.#core = core;
    this.#library = new Library(data);
    this.#player = new Player(core);
    this.#picker = picker;
    this.#problem = problem;
  }

  start(): void {
    const holder = document.createElement("div");
    document.body.append(holder);
    render(<Dialog player={this.#player} library={this.#library} onClose={() => this.#close()} />, holder);
    this.#renderPicker();
    this.#linkTables();
    this.#player.subscribe(() => this.#followMatch());
    window.addEventListener("hashchange", () => this.#followAddress());
    this.#acceptDrops();
    this.#followAddress();
  }

  #renderPicker(): void {
    render(
      <Picker
        library={this.#library}
        problem={this.#problem}
        onWatch={(source) => this.#watch(source)}
        onFiles={(files) => void this.#openFiles(files)}
      />,
      this.#picker,
    );
  }

  /** The content of cells with `data-play` becomes a link to their match. */
  #linkTables(): void {
    for (const element of document.querySelectorAll<HTMLElement>("[data-play]")) {
      const source = this.#library.source(Number(element.dataset["play"]));
      if (!source) {
        continue;
      }
      const link = document.createElement("a");
      link.href = formatLink([{ ...source, step: 0 }]);
      link.className = "w-watch";
      if (element.tagName === "FIGURE") {
        link.textContent = "Watch";
        link.setAttribute("aria-label", `Watch ${visible(source.robot, 120)} in ${visible(source.maze, 120)}`);
        element.querySelector("figcaption")?.append(" ", link);
      } else {
        link.title = `Watch ${visible(source.robot, 120)} in ${visible(source.maze, 120)}`;
        link.append(...element.childNodes);
        element.append(link);
      }
    }
  }

  #watch(source: Source): void {
    const link = formatLink([{ ...source, step: 0 }]);
    if (location.hash === link) {
      this.#player.open([source], 0);
    } else {
      location.hash = link;
    }
  }

  #followAddress(): void {
    const places = parseLink(location.hash);
    const [first] = places;
    if (!first) {
      if (this.#player.panes.length > 0) {
        this.#player.close();
      }
      return;
    }
    const found = places.map((it) => this.#library.find(it)).filter((it) => it !== null);
    const [source] = found;
    if (!source) {
      this.#problem = `This page has no match of ${first.robot} in ${first.maze} with seed ${first.seed}.`;
      this.#renderPicker();
      this.#player.close();
      this.#picker.scrollIntoView();
      return;
    }
    this.#setProblem(null);
    const inMaze = found.filter((it) => it.mazeKey === source.mazeKey);
    this.#player.open(inMaze, first.step);
  }

  #followMatch(): void {
    clearTimeout(this.#addressTimer);
    const { panes, isPlaying } = this.#player;
    if (panes.length === 0 || isPlaying) {
      return;
    }
    this.#addressTimer = setTimeout(() => {
      const { panes, position } = this.#player;
      if (panes.length > 0) {
        this.#setAddress(formatLink(panes.map((pane) => ({ ...pane.source, step: position }))));
      }
    }, ADDRESS_MS);
  }

  #setAddress(hash: string): void {
    if (location.hash !== hash) {
      history.replaceState(null, "", `${this.#home}${hash}`);
    }
  }

  #close(): void {
    clearTimeout(this.#addressTimer);
    this.#player.problem = null;
    this.#player.close();
    history.replaceState(null, "", this.#home);
  }

  #setProblem(problem: string | null): void {
    this.#problem = problem;
    this.#renderPicker();
  }

  async #openFiles(files: File[]): Promise<void> {
    const opened: Source[] = [];
    const problems: string[] = [];
    for (const file of files.slice(0, 20)) {
      try {
        if (file.size > FILE_BYTES_MAX) {
          throw new Error("the file is too large");
        }
        const bytes = new Uint8Array(await file.arrayBuffer());
        opened.push(this.#library.add(this.#core, file.name, bytes));
      } catch (error) {
        problems.push(`${file.name}: ${messageOf(error)}`);
      }
    }
    this.#setProblem(problems.length > 0 ? problems.join("; ") : null);
    const [first] = opened;
    if (first) {
      const inMaze = opened.filter((it) => it.mazeKey === first.mazeKey);
      this.#player.open(inMaze.slice(0, PANES_MAX), 0);
      if (problems.length > 0) {
        this.#player.problem = problems.join("; ");
      }
    } else if (this.#player.panes.length > 0) {
      this.#player.problem = problems.join("; ");
      this.#player.seek(this.#player.position);
    }
  }

  #acceptDrops(): void {
    window.addEventListener("dragover", (event) => event.preventDefault());
    window.addEventListener("drop", (event) => {
      event.preventDefault();
      const files = [...(event.dataTransfer?.files ?? [])];
      if (files.length > 0) {
        void this.#openFiles(files);
      }
    });
  }
}

async function start(): Promise<void> {
  const picker = document.getElementById("wasmouse-player");
  if (!picker) {
    return;
  }
  try {
    const { core, data, problem } = await load();
    new App(core, data, problem, picker).start();
    document.documentElement.dataset["player"] = "ready";
  } catch (error) {
    picker.textContent = `Matches cannot be shown: ${visible(messageOf(error))}`;
    document.documentElement.dataset["player"] = "failed";
  }
  performance.mark("wasmouse-ready");
}

void start();
