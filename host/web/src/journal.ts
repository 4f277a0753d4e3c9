// What a robot's journal shows at a step: paint, labels, beliefs about walls, and log lines.

import type { Note } from "./core";

/** What the robot has written so far. Keys are cell indices. */
export interface Notebook {
  paint: Map<number, string>;
  labels: Map<number, string>;
  /** By cell index times 4 plus side: 1 open, 2 closed. */
  walls: Map<number, number>;
  /** The last ones, the latest first. */
  logs: { step: number; level: string; text: string }[];
}

const LOGS_MAX = 30;

/** The robot writes in step n before its action, so the notes of that step show at n - 1. */
export function notebookAt(notes: Note[], dimension: number, position: number): Notebook {
  const book: Notebook = { paint: new Map(), labels: new Map(), walls: new Map(), logs: [] };
  for (const note of notes) {
    const step = note[0];
    if (step > position + 1) {
      break;
    }
    switch (note[1]) {
      case "log":
        book.logs.push({ step, level: note[2], text: note[3] });
        break;
      case "paint":
        set(book.paint, note[2] * dimension + note[3], note[4] === "none" ? "" : note[4]);
        break;
      case "label":
        set(book.labels, note[2] * dimension + note[3], note[4]);
        break;
      case "wall":
        book.walls.set(4 * (note[2] * dimension + note[3]) + note[4], note[5]);
        break;
    }
  }
  book.logs = book.logs.slice(-LOGS_MAX).reverse();
  return book;
}

function set(map: Map<number, string>, key: number, value: string): void {
  if (value === "") {
    map.delete(key);
  } else {
    map.set(key, value);
  }
}
