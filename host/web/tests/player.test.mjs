// The player in a browser: what a viewer does.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { drawing, launch, open, readSample, reload, sample, status, withPage } from "./browser.mjs";

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser?.close());

const CONTEST = sample("contest.html");
const MATCH = "#flood:reset/tree-16/0";
const OTHER = "wall-follower:left/tree-16/0";

const stepOf = async (page) => Number(/^Step (\d+)/.exec(await status(page))[1]);

test("a link opens a match at a step, and the address follows", async () => {
  await withPage(browser, {}, async (page) => {
    await open(page, CONTEST, `${MATCH}/30`);
    assert.match(await status(page), /^Step 30 of \d+, exploration run; /);
    await page.getByRole("button", { name: "Step forward" }).click();
    assert.equal(await stepOf(page), 31);
    await page.waitForFunction(() => location.hash.endsWith("/31"));
    await page.getByRole("button", { name: "Close the player" }).click();
    assert.equal(await page.locator(".w-dialog[open]").count(), 0);
    assert.equal(await page.evaluate(() => location.hash), "");
    // A link that is followed in an open page, and the browser's back.
    await page.evaluate((hash) => (location.hash = hash), `${MATCH}/7`);
    await page.waitForSelector(".w-dialog[open]");
    assert.equal(await stepOf(page), 7);
    await page.goBack();
    await page.waitForSelector(".w-dialog:not([open])", { state: "attached" });
  });
});

test("tables and pictures have links to matches", async () => {
  await withPage(browser, {}, async (page) => {
    await open(page, CONTEST);
    for (const place of ["#ranking-0", "#scores", "figure"]) {
      const link = page.locator(`${place} a.w-watch`).first();
      assert.match(await link.getAttribute("href"), /^#[^/]+\/[^/]+\/0\/0$/);
      await link.click();
      assert.equal(await stepOf(page), 0, place);
      await page.keyboard.press("Escape");
    }
    // Sorting moves the links with their rows.
    const name = page.locator("#scores tbody tr").first().locator("th");
    const before = await name.textContent();
    const heading = page.locator("#scores thead button").first();
    await heading.click();
    await heading.click();
    assert.notEqual(await name.textContent(), before);
    const row = page.locator("#scores tbody tr").first();
    const maze = await row.locator("th").textContent();
    const href = await row.locator("a.w-watch").first().getAttribute("href");
    assert.equal(decodeURIComponent(href.split("/")[1]), maze);
  });
});

test("a match is chosen from the lists", async () => {
  await withPage(browser, {}, async (page) => {
    await open(page, CONTEST);
    await page.getByRole("combobox", { name: "Maze", exact: true }).selectOption({ label: "tree-16" });
    await page.getByRole("combobox", { name: "Robot", exact: true }).selectOption({ label: "minnett:final" });
    await page.getByRole("button", { name: "Watch", exact: true }).click();
    await page.waitForSelector(".w-dialog[open]");
    assert.equal(await page.locator("#w-title").textContent(), "tree-16");
    assert.match(await page.evaluate(() => location.hash), /^#minnett:final\/tree-16\/0\/0/);
  });
});

test("a match plays, pauses, steps back and ends", async () => {
  await withPage(browser, {}, async (page) => {
    await open(page, CONTEST, `${MATCH}/0`);
    const first = await drawing(page);
    await page.getByLabel("Steps per second").selectOption("10");
    await page.getByRole("button", { name: "Play", exact: true }).click();
    await page.waitForFunction(() => !document.querySelector(".w-status").textContent.startsWith("Step 0 "));
    await page.getByRole("button", { name: "Pause" }).click();
    const paused = await stepOf(page);
    assert.ok(paused > 0);
    const there = await drawing(page);
    assert.notEqual(there, first);
    await page.getByRole("button", { name: "Step back" }).click();
    assert.equal(await stepOf(page), paused - 1);
    assert.notEqual(await drawing(page), there);
    await page.getByRole("button", { name: "Step forward" }).click();
    assert.equal(await drawing(page), there, "the same step looks the same");
    await page.getByLabel("Steps per second").selectOption("250");
    await page.getByRole("button", { name: "Play", exact: true }).click();
    await page.waitForFunction(() => document.querySelector(".w-status").textContent.includes("finished, score"));
    assert.equal(await page.getByRole("button", { name: "Play", exact: true }).count(), 1, "it stops at the end");
    await page.getByRole("button", { name: "To the start" }).click();
    assert.equal(await drawing(page), first);
    await page.getByLabel("Steps per second").selectOption("1");
    await page.locator(".w-drawing").click();
    await page.getByRole("button", { name: "Pause" }).waitFor();
    await page.locator(".w-drawing").click();
    await page.getByRole("button", { name: "Play", exact: true }).waitFor();
  });
});

test("the slider seeks, and events are listed", async () => {
  await withPage(browser, {}, async (page) => {
    await open(page, CONTEST, `${MATCH}/0`);
    await page.getByLabel("Step", { exact: true }).fill("40");
    assert.equal(await stepOf(page), 40);
    assert.match(await page.getByLabel("Step", { exact: true }).getAttribute("aria-valuetext"), /^step 40 of \d+, /);
    await page.getByText(/^Events \(\d+\)$/).click();
    const reset = page.getByRole("button", { name: /^Step \d+: reset$/ });
    const at = Number(/\d+/.exec(await reset.textContent())[0]);
    await reset.click();
    assert.equal(await stepOf(page), at);
    assert.match(await status(page), /speed run/);
    assert.equal(await page.locator(".w-mark-reset").count(), 1);
    await page.getByRole("button", { name: "Previous event" }).click();
    assert.ok((await stepOf(page)) < at);
  });
});

test("each overlay changes the drawing and can be taken away again", async () => {
  await withPage(browser, {}, async (page) => {
    await open(page, CONTEST, `${MATCH}/35`);
    const before = await drawing(page);
    const boxes = page.getByRole("group", { name: "Show" }).getByRole("checkbox");
    const count = await boxes.count();
    assert.equal(count, 7, "without a journal there is no paint");
    for (let index = 0; index < count; index += 1) {
      await boxes.nth(index).click();
      assert.notEqual(await drawing(page), before, `overlay ${index}`);
      await boxes.nth(index).click();
      assert.equal(await drawing(page), before, `overlay ${index}`);
    }
  });
});

test("robots are compared in lockstep", async () => {
  await withPage(browser, {}, async (page) => {
    await open(page, CONTEST, `${MATCH}/50`);
    const compare = page.getByLabel("Compare with");
    await compare.selectOption({ label: "wall-follower:left" });
    await compare.selectOption({ label: "minnett:final" });
    await compare.selectOption({ label: "champion:fast" });
    assert.equal(await page.locator(".w-pane").count(), 4);
    assert.equal(await compare.count(), 0, "four are the most");
    await page.keyboard.press("ArrowRight");
    for (const index of [0, 1, 2, 3]) {
      assert.match(await status(page, index), /^Step 51 of /);
    }
    await page.waitForFunction(() => location.hash.split("+").length === 4);
    const hash = await page.evaluate(() => location.hash);
    // A match that is over waits at its end.
    await page.getByRole("button", { name: "To the end" }).click();
    assert.match(await status(page, 0), /finished, score/);
    assert.match(await status(page, 1), /^Step 1000 of 1000, budget used up/);
    await page.getByRole("button", { name: "Remove wall-follower:left" }).click();
    assert.equal(await page.locator(".w-pane").count(), 3);
    await open(page, CONTEST, hash);
    await reload(page);
    assert.equal(await page.locator(".w-pane").count(), 4, "the address has all of them");
  });
  await withPage(browser, {}, async (page) => {
    await open(page, CONTEST, `${MATCH}/5+${OTHER}/5+flood:reset/braid-12/0/5`);
    assert.equal(await page.locator(".w-pane").count(), 2, "only those in one maze");
  });
});

test("everything works with the keyboard alone", async () => {
  await withPage(browser, {}, async (page) => {
    await open(page, CONTEST);
    const isWatch = () => page.evaluate(() => document.activeElement?.matches("#scores a.w-watch"));
    for (let presses = 0; !(await isWatch()); presses += 1) {
      assert.ok(presses < 300, "a link is reached with Tab");
      await page.keyboard.press("Tab");
    }
    await page.keyboard.press("Enter");
    await page.waitForSelector(".w-dialog[open]");
    const expect = async (key, step) => {
      await page.keyboard.press(key);
      assert.equal(await stepOf(page), step, key);
    };
    await expect("ArrowRight", 1);
    await expect("Shift+ArrowRight", 11);
    await expect("ArrowLeft", 10);
    await expect("Home", 0);
    const before = await drawing(page);
    await page.keyboard.press("5");
    assert.notEqual(await drawing(page), before);
    await page.keyboard.press("5");
    await page.keyboard.press("+");
    assert.equal(await page.getByLabel("Steps per second").inputValue(), "20");
    await page.keyboard.press("-");
    await page.keyboard.press("-");
    assert.equal(await page.getByLabel("Steps per second").inputValue(), "5");
    await page.keyboard.press("]");
    assert.ok((await stepOf(page)) > 0);
    await page.keyboard.press("[");
    assert.equal(await stepOf(page), 0);
    await page.keyboard.press("Space");
    await page.waitForFunction(() => !document.querySelector(".w-status").textContent.startsWith("Step 0 "));
    await page.keyboard.press("Space");
    assert.equal(await page.getByRole("button", { name: "Play", exact: true }).count(), 1);
    await page.keyboard.press("End");
    assert.match(await status(page), /finished, score|budget/);
    // The focus stays inside, and goes back to the link.
    for (let presses = 0; presses < 60; presses += 1) {
      await page.keyboard.press("Tab");
      const isOutside = await page.evaluate(
        () => document.activeElement !== document.body && !document.activeElement?.closest("dialog"),
      );
      assert.ok(!isOutside, "the focus stays in the dialog");
    }
    await page.keyboard.press("Escape");
    assert.equal(await page.locator(".w-dialog[open]").count(), 0);
    assert.ok(await isWatch(), "the focus is back");
  });
});

test("a screen reader hears where the match is, but not every step", async () => {
  await withPage(browser, {}, async (page) => {
    await open(page, CONTEST, `${MATCH}/0`);
    const said = page.locator(".w-dialog [role=status]");
    await page.waitForFunction(() => document.querySelector(".w-dialog [role=status]").textContent !== "");
    await page.evaluate(() => {
      window.changes = 0;
      const region = document.querySelector(".w-dialog [role=status]");
      new MutationObserver(() => (window.changes += 1)).observe(region, { subtree: true, childList: true, characterData: true });
    });
    for (let step = 0; step < 30; step += 1) {
      await page.keyboard.press("ArrowRight");
    }
    await page.waitForFunction(() => document.querySelector(".w-dialog [role=status]").textContent.startsWith("Step 30 "));
    assert.ok((await page.evaluate(() => window.changes)) < 10);
    assert.match(await said.textContent(), /exploration run/);
    assert.match(await page.locator("canvas").getAttribute("aria-label"), /^flood:reset at \(\d+, \d+\), facing \w+, in tree-16$/);
  });
});

test("nothing moves on its own, and with reduced motion nothing slides", async () => {
  await withPage(browser, { reducedMotion: "reduce" }, async (page) => {
    await open(page, CONTEST, `${MATCH}/0`);
    const first = await drawing(page);
    await page.waitForTimeout(300);
    assert.equal(await drawing(page), first);
    await page.getByLabel("Steps per second").selectOption("1");
    await page.getByRole("button", { name: "Play", exact: true }).click();
    await page.waitForTimeout(300);
    const [says, picture] = await page.evaluate(() => [
      document.querySelector(".w-status").textContent,
      document.querySelector(".w-drawing canvas").toDataURL(),
    ]);
    // A machine that was too slow has nothing to compare.
    if (says.startsWith("Step 0 ")) {
      assert.equal(picture, first, "the robot jumps from step to step");
    }
  });
});

test("a page prints its match", async () => {
  await withPage(browser, {}, async (page) => {
    await open(page, CONTEST, `${MATCH}/20`);
    await page.emulateMedia({ media: "print" });
    assert.ok(await page.locator(".w-drawing canvas").isVisible());
    assert.ok(!(await page.locator("#ranking-0").isVisible()));
    assert.ok(!(await page.locator(".w-transport").isVisible()));
    await page.pdf({ format: "A4" });
  });
});

test("a link to a match that is not there says so", async () => {
  await withPage(browser, {}, async (page) => {
    await open(page, CONTEST, "#no%3Cb%3E/such/0/1");
    assert.match(await page.getByRole("alert").textContent(), /no match of no<b> in such with seed 0/);
    for (const hash of ["#/", "#a/b/c/-1", "#%/%/%/1", "#a/b/c/99999999999", `#${"x/".repeat(5000)}`]) {
      await open(page, CONTEST, hash);
      await reload(page);
      assert.equal(await page.locator(".w-dialog[open]").count(), 0, hash.slice(0, 40));
    }
    await open(page, CONTEST, `${MATCH}/999999`);
    await reload(page);
    assert.match(await status(page), /finished, score/, "a step beyond the end is the end");
  });
});

test("the page is small", async () => {
  const size = async (name) => (await readSample(name)).length;
  const [one, big] = [await size("one.html"), await size("big.html")];
  console.log(`page of one match: ${one} bytes; 5 robots in 200 mazes: ${big} bytes`);
  assert.ok(one < 400_000, `${one} bytes`);
  assert.ok(big < 1_500_000, `${big} bytes`);
});
