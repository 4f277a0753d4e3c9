// What the browser tests share: a browser, and pages that fail on errors and requests.

import { readFile } from "node:fs/promises";
import path from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

/** The folder that `web-samples` has filled. */
export const SAMPLES = process.env.WASMOUSE_SAMPLES ?? "samples";

export const sample = (name) => path.join(SAMPLES, name);

export const readSample = (name) => readFile(sample(name), "utf8");

export const urlOf = (file, hash = "") => pathToFileURL(path.resolve(file)).href + hash;

/** Starts the browser. As root it cannot use its own sandbox; nothing but our pages is opened. */
export function launch() {
  const isRoot = process.getuid?.() === 0 || process.env.CI !== undefined;
  return chromium.launch({
    executablePath: process.env.WASMOUSE_BROWSER,
    args: isRoot ? ["--no-sandbox"] : [],
  });
}

/**
 * Runs `test` with a new page. Afterwards there must have been no message on the console, no error,
 * and no request but that of the page itself.
 */
export async function withPage(browser, options, test) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options });
  const page = await context.newPage();
  const complaints = [];
  page.on("console", (message) => complaints.push(`console: ${message.text()}`));
  page.on("pageerror", (error) => complaints.push(`error: ${error.stack}`));
  page.on("dialog", (dialog) => {
    complaints.push(`dialog: ${dialog.message()}`);
    void dialog.dismiss();
  });
  let documents = 0;
  page.on("request", (request) => {
    const isDocument = request.isNavigationRequest() && request.url().startsWith("file:");
    documents += isDocument ? 1 : 0;
    // Links to a step are no requests.
    if (!isDocument) {
      complaints.push(`request: ${request.url().slice(0, 200)}`);
    }
  });
  try {
    await test(page);
    if (complaints.length > 0) {
      throw new Error(complaints.join("\n"));
    }
  } finally {
    await context.close();
  }
}

/** Opens a page and waits until its player is ready. */
export async function open(page, file, hash = "") {
  await page.goto(urlOf(file, hash));
  await page.waitForFunction(() => document.documentElement.dataset.player !== undefined);
}

/** Loads the page again and waits in the same way. */
export async function reload(page) {
  await page.reload();
  await page.waitForFunction(() => document.documentElement.dataset.player !== undefined);
}

export const status = (page, index = 0) => page.locator(".w-status").nth(index).textContent();

/** The picture of a drawing, as text that is the same for the same picture. */
export const drawing = (page, index = 0) =>
  page
    .locator(".w-drawing canvas")
    .nth(index)
    .evaluate((canvas) => canvas.toDataURL());
