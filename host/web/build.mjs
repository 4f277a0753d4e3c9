// Builds the player into `prebuilt`, or into the folder that is given: player.js and player.css.
// The core beside them is built by `cargo xtask web`, which calls this.

import { build } from "esbuild";
import { readFile } from "node:fs/promises";
import path from "node:path";
import { fileURLToPath } from "node:url";

const here = path.dirname(fileURLToPath(import.meta.url));
const output = path.resolve(process.argv[2] ?? path.join(here, "prebuilt"));

// Preact's licence asks for its text in every copy.
const licence = (await readFile(path.join(here, "node_modules/preact/LICENSE"), "utf8")).trim();

await build({
  absWorkingDir: here,
  entryPoints: [
    { in: "src/main.tsx", out: "player" },
    { in: "src/player.css", out: "player" },
  ],
  outdir: output,
  bundle: true,
  minify: true,
  format: "iife",
  target: ["es2022"],
  jsx: "automatic",
  jsxImportSource: "preact",
  legalComments: "none",
  banner: {
    js: `/*\nThe player of wasmouse, made of host/web.\n\nWith Preact:\n\n${licence}\n*/`,
  },
  logLevel: "warning",
});
