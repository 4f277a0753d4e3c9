// Hostile and damaged input shows text and nothing else.

import assert from "node:assert/strict";
import { mkdtemp, rm, writeFile } from "node:fs/promises";
import os from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { drawing, launch, open, readSample, reload, sample, status, withPage } from "./browser.mjs";

let browser;
let folder;
before(async () => {
  browser = await launch();
  folder = await mkdtemp(path.join(os.tmpdir(), "wasmouse-web-"));
});
after(async () => {
  await browser?.close();
  await rm(folder, { recursive: true, force: true });
});

const CONTEST = sample("contest.html");

/** Nothing of the text of others has become an element, an attribute or a script. */
async function assertHarmless(page) {
  assert.notEqual(await page.title(), "owned");
  // The page brings its plots as images, and no others.
  assert.equal(await page.locator("img:not(figure.plot img)").count(), 0);
  assert.equal(await page.locator("img:not([src^=\"data:image/svg+xml;base64,\"])").count(), 0);
  assert.equal(await page.locator("[onerror]").count(), 0);
  assert.equal(await page.locator("script").count(), 5, "the page's own");
}

test("hostile names and messages are text", async () => {
  await withPage(browser, {}, async (page) => {
    await open(page, sample("hostile.html"));
    await assertHarmless(page);
    const links = page.locator("#scores a.w-watch");
    assert.equal(await links.count(), 6);
    for (let index = 0; index < 6; index += 1) {
      await links.nth(index).click();
      await page.waitForSelector(".w-dialog[open]");
      await assertHarmless(page);
      const title = await page.locator("#w-title").textContent();
      assert.ok(title.includes("</script><script>"), title);
      assert.ok(title.includes("\\u{202e}") && !title.includes("\u202e"), "what is invisible is shown");
      await page.waitForFunction(() => location.hash.endsWith("/0"));
      await reload(page);
      assert.equal(await page.locator(".w-dialog[open]").count(), 1, "the link works with any name");
      const outside = await page.evaluate(() => document.querySelector(".w-dialog").scrollWidth > innerWidth);
      assert.ok(!outside, "long names do not break the layout");
      await page.keyboard.press("Escape");
    }
    assert.match(await page.locator(".w-picker").textContent(), /onerror/);
  });
});

const choose = (page, files) => page.locator(".w-file input").setInputFiles(files);

const file = (name, content) => ({ name, mimeType: "application/json", buffer: Buffer.from(content) });

test("replay files are opened, compared, and dropped on the page", async () => {
  const good = await readSample("good.replay.json");
  await withPage(browser, {}, async (page) => {
    await open(page, CONTEST);
    await choose(page, sample("good.replay.json"));
    await page.waitForSelector(".w-dialog[open]");
    assert.equal(await page.locator("#w-title").textContent(), "hall");
    assert.match(await page.locator(".w-head").textContent(), /seed 18446744073709551615/);
    assert.match(await status(page), /^Step 0 of 60, exploration run/);
    assert.match(await page.locator(".w-logs").textContent(), /all is well/);
    await page.keyboard.press("Shift+ArrowRight");
    for (const key of ["8", "9"]) {
      const before = await drawing(page);
      await page.keyboard.press(key);
      assert.notEqual(await drawing(page), before, `overlay ${key} with a journal`);
    }
    await page.keyboard.press("Escape");
    await choose(page, [sample("good.replay.json"), sample("other.replay.json")]);
    await page.waitForSelector(".w-dialog[open]");
    assert.equal(await page.locator(".w-pane").count(), 2, "files of one maze are side by side");
    await page.keyboard.press("Escape");
    await page.evaluate((text) => {
      const data = new DataTransfer();
      data.items.add(new File([text], "dropped.json"));
      window.dispatchEvent(new DragEvent("drop", { dataTransfer: data, cancelable: true }));
    }, good);
    await page.waitForSelector(".w-dialog[open]");
    assert.equal(await page.locator(".w-pane").count(), 1);
  });
});

test("the text of a hostile robot's replay is text", async () => {
  await withPage(browser, {}, async (page) => {
    await open(page, CONTEST);
    await choose(page, sample("hostile.replay.json"));
    await page.waitForSelector(".w-dialog[open]");
    for (const key of ["8", "9", "End"]) {
      await page.keyboard.press(key);
    }
    await assertHarmless(page);
    const logs = await page.locator(".w-logs").textContent();
    assert.ok(logs.includes("</script>") && logs.includes("\\u{1b}") && !logs.includes("\u001b"), logs.slice(0, 200));
  });
});

/** Damaged replays: the name of the damage, and the file. */
function damaged(good) {
  const json = JSON.parse(good);
  const kinds = [];
  const add = (name, content) => kinds.push([name, content]);
  const change = (name, edit) => {
    const copy = structuredClone(json);
    edit(copy);
    add(name, JSON.stringify(copy));
  };
  add("empty", "");
  add("no JSON", "hello");
  add("HTML", "<script>document.title='owned'</script>");
  add("a list", "[]");
  add("null", "null");
  add("cut in the middle", good.slice(0, good.length / 2));
  add("cut by a character", good.slice(0, -1));
  add("text after it", `${good}x`);
  add("twice", good + good);
  add("a byte order mark", `\ufeff${good}`);
  add("no UTF-8", Buffer.from(good).fill(0xff, 40, 44));
  add("gzip", Buffer.from([0x1f, 0x8b, 8, 0, 0, 0, 0, 0]));
  add("nested deeply", "[".repeat(100_000));
  add("nested objects", `${'{"maze":'.repeat(50_000)}`);
  add("a key twice", good.replace('"version":1', '"version":1,"version":1'));
  add("16 MiB of spaces", " ".repeat(17 * 1024 * 1024));
  change("another format", (it) => (it.format = "other"));
  change("another version", (it) => (it.version = 2));
  change("a version of text", (it) => (it.version = "1"));
  for (const key of Object.keys(json)) {
    change(`without ${key}`, (it) => delete it[key]);
  }
  change("an unknown key", (it) => (it.extra = 1));
  change("a key of JavaScript", (it) => Object.defineProperty(it, "__proto__", { value: {}, enumerable: true }));
  change("a long name", (it) => (it.robot = "x".repeat(201)));
  change("another name", (it) => (it.robot = "cat"));
  change("markup as a name", (it) => (it.robot = "<img src=x onerror=alert(1)>"));
  change("another maze name", (it) => (it.maze.name = "wall"));
  change("a wall", (it) => (it.maze.columns[3] = it.maze.columns[3].replace(/./, (it) => (it === "0" ? "1" : "0"))));
  change("no digit", (it) => (it.maze.columns[3] = `g${it.maze.columns[3].slice(1)}`));
  change("a short column", (it) => (it.maze.columns[3] = it.maze.columns[3].slice(1)));
  change("no columns", (it) => (it.maze.columns = []));
  change("300 columns", (it) => (it.maze.columns = new Array(300).fill("0".repeat(300))));
  change("a start outside", (it) => (it.maze.start = { x: 200, y: 0 }));
  change("an empty goal", (it) => (it.maze.goal.width = 0));
  change("no Base64", (it) => (it.transcript = "*".repeat(8)));
  change("an empty transcript", (it) => (it.transcript = ""));
  change("a short transcript", (it) => (it.transcript = Buffer.from(it.transcript, "base64").subarray(0, -1).toString("base64")));
  change("a long transcript", (it) => (it.transcript = Buffer.concat([Buffer.from(it.transcript, "base64"), Buffer.from([50])]).toString("base64")));
  change("another action", (it) => {
    const bytes = Buffer.from(it.transcript, "base64");
    bytes[10] ^= 1;
    it.transcript = bytes.toString("base64");
  });
  change("other rules", (it) => (it.rules.game.budget += 1));
  change("rules of 0", (it) => (it.rules.game.longest_move = 0));
  change("other steps", (it) => (it.record.steps.exploration += 1));
  change("a negative number", (it) => (it.record.steps.exploration = -1));
  change("another verdict", (it) => (it.record.verdict = { kind: "finished", score: { thousandths: 1000, speed_steps: 1, exploration_steps: 0, exploration_divisor: 30 } }));
  change("other fuel", (it) => (it.record.fuel.steps = 7));
  change("another digest", (it) => (it.digest = "0".repeat(64)));
  change("another log line", (it) => (it.journal[0].text = "bad"));
  change("a note of another kind", (it) => (it.journal[0].note = "html"));
  change("a colour that is none", (it) => (it.journal.find((it) => it.note === "paint").color = "url(x)"));
  return kinds;
}

test("damaged replays say what is wrong", async () => {
  const kinds = damaged(await readSample("good.replay.json"));
  assert.ok(kinds.length >= 50, `${kinds.length} kinds`);
  await withPage(browser, {}, async (page) => {
    await open(page, CONTEST);
    const messages = new Set();
    for (const [name, content] of kinds) {
      await choose(page, [file(`${name}.json`, content)]);
      const alert = page.locator(".w-picker [role=alert]");
      await page.waitForFunction((name) => document.querySelector(".w-picker [role=alert]").textContent.startsWith(name), `${name}.json: `);
      const message = await alert.textContent();
      assert.ok(message.length < 600 && !message.includes("internal error"), message);
      assert.equal(await page.locator(".w-dialog[open]").count(), 0, name);
      messages.add(message.slice(name.length));
    }
    await assertHarmless(page);
    assert.ok(messages.size > 25, `only ${messages.size} different messages`);
    // And a good one is still opened.
    await choose(page, sample("good.replay.json"));
    await page.waitForSelector(".w-dialog[open]");
    assert.equal(await page.locator(".w-picker [role=alert]").textContent(), "");
  });
});

test("a page with damaged data says so and stays usable", async () => {
  const page = await readSample("one.html");
  const index = JSON.parse(/id="wasmouse-index">([^<]*)</.exec(page)[1]);
  const withIndex = (json) => page.replace(/(id="wasmouse-index">)[^<]*/, (_, start) => start + json);
  const edited = (edit) => {
    const copy = structuredClone(index);
    edit(copy);
    return withIndex(JSON.stringify(copy));
  };
  const kinds = {
    "no JSON": [withIndex("{"), /not JSON/],
    "no object": [withIndex("[]"), /expected an object/],
    "another version": [edited((it) => (it.version = 2)), /version 2 is not supported/],
    "no rules": [edited((it) => delete it.rules), /rules: expected a list/],
    "three rules": [edited((it) => it.rules.pop()), /expected 4 numbers/],
    "a robot that is not there": [edited((it) => (it.matches[0][0] = 5)), /match 0: expected a number/],
    "a maze that is not there": [edited((it) => (it.matches[0][1] = -1)), /match 0: expected a number/],
    "a length beyond the data": [edited((it) => (it.matches[0][3] += 1)), /truncated/],
    "a length short of the data": [edited((it) => (it.matches[0][3] -= 1)), /longer than the index says/],
    "a name of numbers": [edited((it) => (it.robots[0] = 1)), /robots: expected text/],
    "no base64": [page.replace(/(id="wasmouse-bytes">)[^<]*/, (_, start) => `${start}*`), /not base64/],
    "no gzip": [page.replace(/(id="wasmouse-bytes">)..../, (_, start) => `${start}AAAA`), /compressed data is damaged/],
    "half of it": [page.replace(/(id="wasmouse-bytes">)([^<]{100})[^<]*/, (_, start, half) => start + half), /compressed data is damaged/],
  };
  await withPage(browser, {}, async (tab) => {
    for (const [name, [html, message]] of Object.entries(kinds)) {
      const path_ = path.join(folder, "damaged.html");
      await writeFile(path_, html);
      await open(tab, path_);
      assert.match(await tab.getByRole("alert").textContent(), message, name);
      assert.equal(await tab.locator("#ranking-0 tbody tr").count(), 1, "the rest of the page is there");
      await choose(tab, sample("good.replay.json"));
      await tab.waitForSelector(".w-dialog[open]");
    }
    const path_ = path.join(folder, "core.html");
    await writeFile(path_, page.replace(/(id="wasmouse-core">)[^<]*/, (_, start) => `${start}AAAA`));
    await open(tab, path_);
    assert.match(await tab.locator("#wasmouse-player").textContent(), /Matches cannot be shown/);
    const match = path.join(folder, "match.html");
    await writeFile(match, edited((it) => (it.rules[0] = 10)));
    await open(tab, match);
    await tab.locator("a.w-watch").first().click();
    assert.match(await tab.locator(".w-dialog [role=alert]").textContent(), /after the end of the match/);
  });
});
