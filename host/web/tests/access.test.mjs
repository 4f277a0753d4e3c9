// Accessibility, as axe sees it.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { AxeBuilder } from "@axe-core/playwright";
import { launch, open, readSample, sample, withPage } from "./browser.mjs";

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser?.close());

// Small, because axe looks at every element.
const CONTEST = sample("small.html");
const [, index] = /id="wasmouse-index">([^<]*)</.exec(await readSample("small.html"));
const { robots, mazes } = JSON.parse(index);
const [first, second] = robots.map((it) => `${it}/${encodeURIComponent(mazes[0][0])}/0/40`);
const PLACES = {
  page: "",
  player: `#${first}`,
  comparison: `#${first}+${second}`,
};
const LOOKS = {
  light: { colorScheme: "light" },
  dark: { colorScheme: "dark" },
  narrow: { viewport: { width: 360, height: 740 }, colorScheme: "light" },
};

for (const [look, options] of Object.entries(LOOKS)) {
  for (const [place, hash] of Object.entries(PLACES)) {
    test(`axe finds nothing: ${place}, ${look}`, async () => {
      await withPage(browser, options, async (page) => {
        await open(page, CONTEST, hash);
        await page.evaluate(() => {
          for (const details of document.querySelectorAll("details")) {
            details.open = true;
          }
        });
        const panes = await page.locator(".w-pane").count();
        assert.equal(panes, hash === "" ? 0 : hash.split("+").length);
        const { violations, passes } = await new AxeBuilder({ page }).analyze();
        const found = violations.map((it) => `${it.id}: ${it.nodes.map((node) => node.html).slice(0, 3).join(" ")}`);
        assert.deepEqual(found, []);
        assert.ok(passes.length > 10, "axe has looked at something");
        const isWide = await page.evaluate(() => document.documentElement.scrollWidth > innerWidth);
        assert.ok(!isWide, "nothing is cut off at the side");
      });
    });
  }
}

test("axe would find something", async () => {
  await withPage(browser, {}, async (page) => {
    await open(page, CONTEST);
    await page.evaluate(() => document.body.append(document.createElement("button")));
    const { violations } = await new AxeBuilder({ page }).analyze();
    assert.deepEqual(violations.map((it) => it.id), ["button-name"]);
  });
});
