// Builds the player into `prebuilt`, or into the folder that is given: player.js and player.css.
// The core beside them is built by `cargo xtask web`, which calls this.

import { build } from "esbuild";
import { fileURLToPath } from "node:url";
import path from "node:path";

const here = path.dirname(fileURLToPath(import.meta.url));
const output = path.resolve(process.argv[2] ?? path.join(here, "prebuilt"));

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
    js: "/* The player of wasmouse, made of host/web. With Preact, (c) Jason Miller, MIT licence. */",
  },
  logLevel: "warning",
});
