// How fast the page is. The bounds are generous; the figures are printed.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { launch, open, sample, status, withPage } from "./browser.mjs";

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser?.close());

test("a match of 1,000 steps seeks within a frame", async () => {
  await withPage(browser, {}, async (page) => {
    await open(page, sample("one.html"));
    await page.locator("a.w-watch").first().click();
    assert.match(await status(page), /^Step 0 of 1000/);
    for (const overlays of ["", "567"]) {
      for (const digit of overlays) {
        await page.keyboard.press(digit);
      }
      const times = await page.evaluate(async () => {
        const slider = document.querySelector(".w-slider");
        const times = [];
        for (let round = 0; round < 70; round += 1) {
          const step = (round * 617) % 1001;
          const start = performance.now();
          slider.value = String(step);
          slider.dispatchEvent(new Event("input", { bubbles: true }));
          // The rest of the page follows in microtasks; then the layout.
          for (let turn = 0; turn < 5; turn += 1) {
            await Promise.resolve();
          }
          document.body.getBoundingClientRect();
          times.push(performance.now() - start);
          if (!document.querySelector(".w-status").textContent.startsWith(`Step ${step} of`)) {
            throw new Error("the page did not follow in time to be measured");
          }
          await new Promise((resolve) => requestAnimationFrame(resolve));
        }
        return times.slice(20).sort((a, b) => a - b);
      });
      const [median, p95, most] = [times[25], times[47], times.at(-1)].map((it) => it.toFixed(1));
      console.log(`seek in 1,000 steps${overlays && " with all overlays"}: median ${median} ms, 95 % ${p95} ms, most ${most} ms`);
      assert.ok(times[25] < 100, `${median} ms`);
    }
  });
});

test("a page of 1,000 matches is interactive soon", async () => {
  await withPage(browser, {}, async (page) => {
    const times = [];
    for (let round = 0; round < 3; round += 1) {
      await open(page, sample("big.html"));
      times.push(await page.evaluate(() => performance.getEntriesByName("wasmouse-ready")[0].startTime));
      assert.ok((await page.locator("#scores a.w-watch").count()) === 1000);
    }
    console.log(`interactive after ${times.map((it) => Math.round(it)).join(", ")} ms`);
    await page.locator("#scores a.w-watch").last().click();
    await page.waitForSelector(".w-dialog[open]");
    assert.ok(Math.min(...times) < 10_000);
  });
});
