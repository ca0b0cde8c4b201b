// A wave machine, live: its robots carry the waves of its threads in turn, and a step is one edge of its clock.

import assert from "node:assert/strict";
import { test } from "node:test";

import { cycle, setInput } from "./browser.mjs";
import { opened } from "./opened.mjs";

// Its loop has two robots, so that two machines are at work at once.
const FLIP_FLOP = `//! A flip-flop that is set, cleared, held or flipped.

circuit flip_flop(set, clear, clk) -> (q) {
    q = register((set and not q) or (q and not clear), clk)
}

swarm wave { circuit: flip_flop, registers: waves, beat: 1 cycle }

test flip_flop "flips while both are on" {
    set clear clk | q
    0   0     0   | 0
    1   1     ^   | 1
    1   1     ^   | 0
    1   1     ^   | 1
    0   0     ^   | 1
    0   1     ^   | 0
}
`;

const here = opened({ "flip_flop.nb": FLIP_FLOP }, "flip_flop.nb", async page => {
  await page.getByText(/, a step of \d+ cycles, \d+ threads at once$/).waitFor();
  await page.locator("[data-do=reset]").click();
  await page.waitForFunction(() => document.querySelector(".cycle").textContent === "cycle 0");
});

/** The number of the thread that each robot of the schematic carries. */
function threads(page) {
  return page.locator('.schematic [data-id^="cell-"] .thread').allTextContents();
}

test("a step runs all its cycles, after which each robot carries the same thread again", async () => {
  const { page } = here;
  const title = await page.locator("[data-do=wave-step]").getAttribute("title");
  const [, step] = /^A step has (\d+) cycles$/.exec(title).map(Number);
  await page.getByText(`, a step of ${step} cycles, ${step} threads at once`).waitFor();
  assert.ok((await threads(page)).every(thread => thread === ""));
  await page.locator("[data-do=step]").click();
  await page.waitForFunction(() => document.querySelector(".schematic .thread")?.textContent !== "");
  const first = await threads(page);
  await page.locator("[data-do=step]").click();
  await page.waitForFunction(before => document.querySelector(".schematic .thread")?.textContent !== before, first[0]);
  const second = await threads(page);
  assert.deepEqual(
    second.map(Number),
    first.map(thread => (Number(thread) % step) + 1),
  );
  await page.locator("[data-do=wave-step]").click();
  await page.waitForFunction(now => document.querySelector(".cycle").textContent === `cycle ${now}`, 2 + step);
  assert.equal(await cycle(page), 2 + step);
  // The picture follows the count of cycles a little later.
  await page.waitForFunction(wanted => {
    const cells = [...document.querySelectorAll('.schematic [data-id^="cell-"]')];
    const shown = cells.map(cell => [cell.querySelector(".thread").textContent, cell.getAttribute("data-thread")]);
    return shown.every(([text, color], at) => text === wanted[at] && color === wanted[at]);
  }, second);
});

test("its registers are those of each thread after its last step", async () => {
  const { page } = here;
  const register = thread => page.locator(`.state [data-register="q"][data-of="${thread}"]`);
  await page.locator("[data-do=reset]").click();
  await page.locator("[data-do=state]").click();
  await page.waitForFunction(() => document.querySelector(".cycle").textContent === "cycle 0");
  const threads = await page.locator('.state [data-register="q"]').allTextContents();
  assert.ok(threads.length > 1 && threads.every(value => value === "0"), threads.join());
  await setInput(page, "set", 1);
  await setInput(page, "clear", 1);
  // The flip-flop flips in each step, and the second thread follows the first.
  for (const [thread, value] of [
    [1, "1"],
    [2, "1"],
    [1, "0"],
    [2, "0"],
  ]) {
    while ((await register(thread).textContent()) !== value) {
      const now = await cycle(page);
      await page.locator("[data-do=step]").click();
      await page.waitForFunction(done => document.querySelector(".cycle").textContent === `cycle ${done}`, now + 1);
      // The view is drawn after the count.
      await page.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done))));
    }
  }
  await page.locator("[data-do=state]").click();
});

test("its clock is no switch", async () => {
  const clock = here.page.locator('button[data-input="clk"]');
  assert.ok(await clock.isDisabled());
  assert.equal(await clock.getAttribute("title"), "Each step is a clock edge");
  assert.ok(await here.page.locator(".clock").isHidden());
});

test("the rows of its test say their thread", async () => {
  await here.page.locator("#tab-tests").click();
  await here.page.locator(".test [data-do=physics]").click();
  await here.page.getByText("✓ passes in physics").waitFor();
  assert.ok((await here.page.getByText("thread 2", { exact: true }).count()) > 0);
});
