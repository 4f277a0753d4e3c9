// The core of wasmouse as a module of WebAssembly; host/web/core/src/lib.rs describes its
// interface. Nothing here draws.

interface Exports {
  memory: WebAssembly.Memory;
  reserve(length: number): number;
  output(): number;
  output_length(): number;
  open_match(): number;
  open_replay(): number;
  about(handle: number): number;
  poses(handle: number): number;
  audit(handle: number): number;
  frame(handle: number, step: number): number;
  close(handle: number): number;
}

/** A note of a robot's journal: the step, the kind, and what it says. */
export type Note =
  | [step: number, kind: "log", level: string, text: string]
  | [step: number, kind: "paint", x: number, y: number, color: string]
  | [step: number, kind: "label", x: number, y: number, text: string]
  | [step: number, kind: "wall", x: number, y: number, side: number, belief: number];

/** What does not change while a match is watched. All text is untrusted. */
export interface About {
  origin: { robot: string; maze: string; seed: string } | null;
  dimension: number;
  start: [number, number];
  goal: [x: number, y: number, width: number, height: number];
  walls: number[];
  mazeDigest: string;
  last: number;
  explorationSteps: number;
  speedSteps: number;
  verdict: string;
  fault: string | null;
  score: string | null;
  oracleScore: string | null;
  oracleSpeedSteps: number | null;
  milestones: [position: number, name: string][];
  certainAt: number | null;
  atReset: [optimistic: number | null, pessimistic: number | null] | null;
  idleSteps: number;
  regret: [exploration: number, speed: number] | null;
  contradictions: number;
  notes: Note[];
  notesLeftOut: number;
  traceDigest: string;
}

/** What a step did, or the next one does. */
export interface StepDone {
  isReset: boolean;
  /** 0 left, 1 straight, 2 right. */
  turn: number;
  advance: number;
  /** As in `Trace::identity_bytes`. */
  event: number;
  cells: number;
}

/** What there is to see at a position. -1 stands for none. */
export interface Frame {
  position: number;
  run: number;
  x: number;
  y: number;
  heading: number;
  explorationSteps: number;
  speedSteps: number;
  goalReached: boolean;
  sensors: [left: number, front: number, right: number];
  optimistic: number;
  pessimistic: number;
  unknownWalls: number;
  newWalls: number;
  done: StepDone | null;
  next: StepDone | null;
  /** x and y of each. */
  stops: Int32Array;
  path: Int32Array;
  /** By cell. */
  visits: Int32Array;
  beliefs: Int32Array;
  distances: Int32Array;
}

/** The core says that something is wrong with what it was given. */
export class CoreError extends Error {}

const HEAD = 27;

/** An open match. */
export class Match {
  readonly about: About;
  /** By position: run, x, y, heading. */
  readonly poses: Uint8Array;
  /** By position: new walls, optimistic, pessimistic. */
  readonly audit: Int32Array;
  readonly #core: Core;
  readonly #generation: number;
  readonly #handle: number;

  constructor(core: Core, handle: number, generation: number) {
    this.#core = core;
    this.#handle = handle;
    this.#generation = generation;
    this.about = JSON.parse(new TextDecoder().decode(this.#ask("about"))) as About;
    this.poses = this.#ask("poses");
    this.audit = numbers(this.#ask("audit"));
  }

  frame(position: number): Frame {
    const all = numbers(this.#core.call("frame", this.#generation, this.#handle, position));
    const at = (index: number) => all[index] as number;
    const cells = this.about.dimension ** 2;
    let from = HEAD;
    const take = (length: number) => all.subarray(from, (from += length));
    return {
      position: at(0),
      run: at(1),
      x: at(2),
      y: at(3),
      heading: at(4),
      explorationSteps: at(5),
      speedSteps: at(6),
      goalReached: at(7) === 1,
      sensors: [at(8), at(9), at(10)],
      optimistic: at(11),
      pessimistic: at(12),
      unknownWalls: at(13),
      newWalls: at(14),
      done: stepDone(all.subarray(15, 20)),
      next: stepDone(all.subarray(20, 25)),
      stops: take(2 * at(25)),
      path: take(2 * at(26)),
      visits: take(cells),
      beliefs: take(cells),
      distances: take(cells),
    };
  }

  close(): void {
    this.#core.forget(this.#generation, this.#handle);
  }

  #ask(what: "about" | "poses" | "audit"): Uint8Array {
    return this.#core.call(what, this.#generation, this.#handle);
  }
}

/** An instance of the module, which is replaced should it ever trap. */
export class Core {
  readonly #module: WebAssembly.Module;
  #exports: Exports;
  #generation = 0;

  private constructor(module: WebAssembly.Module) {
    this.#module = module;
    this.#exports = instantiate(module);
  }

  static async load(bytes: BufferSource): Promise<Core> {
    return new Core(await WebAssembly.compile(bytes));
  }

  /** Opens a match from its rules, the identity bytes of its maze, and its transcript. */
  openMatch(rules: Rules, maze: Uint8Array, transcript: Uint8Array): Match {
    const bytes = new Uint8Array(14 + maze.length + transcript.length);
    const view = new DataView(bytes.buffer);
    view.setUint32(0, rules[0], true);
    view.setUint8(4, rules[1]);
    view.setUint8(5, rules[2]);
    view.setUint32(6, rules[3], true);
    view.setUint32(10, maze.length, true);
    bytes.set(maze, 14);
    bytes.set(transcript, 14 + maze.length);
    return this.#open("open_match", bytes);
  }

  /** Opens a replay file. */
  openReplay(bytes: Uint8Array): Match {
    return this.#open("open_replay", bytes);
  }

  #open(what: "open_match" | "open_replay", bytes: Uint8Array): Match {
    const handle = this.#guard((core) => {
      const address = core.reserve(bytes.length);
      if (address === 0) {
        throw new CoreError("the file is too large");
      }
      new Uint8Array(core.memory.buffer).set(bytes, address);
      const handle = core[what]();
      if (handle === 0) {
        throw new CoreError(new TextDecoder().decode(outputOf(core)));
      }
      return handle;
    });
    return new Match(this, handle, this.#generation);
  }

  /** Calls a function about a match and returns a copy of its output. */
  call(
    what: "about" | "poses" | "audit" | "frame",
    generation: number,
    handle: number,
    step = 0,
  ): Uint8Array {
    if (generation !== this.#generation) {
      throw new CoreError("the player was restarted; open the match again");
    }
    return this.#guard((core) => {
      const isAnswered = what === "frame" ? core.frame(handle, step) : core[what](handle);
      const output = outputOf(core).slice();
      if (isAnswered === 0) {
        throw new CoreError(new TextDecoder().decode(output));
      }
      return output;
    });
  }

  forget(generation: number, handle: number): void {
    if (generation === this.#generation) {
      this.#guard((core) => core.close(handle));
    }
  }

  /** The state of an instance that has trapped is unknown, so nothing of it is used again. */
  #guard<T>(call: (core: Exports) => T): T {
    try {
      return call(this.#exports);
    } catch (error) {
      if (error instanceof CoreError) {
        throw error;
      }
      this.#exports = instantiate(this.#module);
      this.#generation += 1;
      throw new CoreError("this match cannot be shown: the player ran into an internal error");
    }
  }
}

/** Budget, budget scope (0 both runs, 1 each run), longest move, exploration divisor. */
export type Rules = [budget: number, scope: number, longestMove: number, divisor: number];

function instantiate(module: WebAssembly.Module): Exports {
  return new WebAssembly.Instance(module, {}).exports as unknown as Exports;
}

function outputOf(core: Exports): Uint8Array {
  return new Uint8Array(core.memory.buffer, core.output(), core.output_length());
}

function numbers(bytes: Uint8Array): Int32Array {
  return new Int32Array(bytes.buffer, bytes.byteOffset, bytes.byteLength / 4);
}

function stepDone(part: Int32Array): StepDone | null {
  const [action, turn, advance, event, cells] = part as unknown as number[];
  if (action === undefined || action < 0) {
    return null;
  }
  return {
    isReset: action === 1,
    turn: turn ?? -1,
    advance: advance ?? 0,
    event: event ?? 0,
    cells: cells ?? 0,
  };
}
