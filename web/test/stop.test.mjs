// While the page computes it answers, and what takes long ends at once.

import assert from "node:assert/strict";
import { test } from "node:test";

import { BROWSER, visit, walking, within } from "./browser.mjs";
import { served } from "./opened.mjs";
import { LATCH, SITE } from "./program.mjs";

/** Multiplication does not depend on the order, which takes minutes to prove. */
const HARD = `circuit product(a[10], b[10], c[10]) -> (same) {
    same = (a * b) * c == a * (b * c)
}

prove product "the order does not matter" {
    always same
}

test product "of nothing is the same" {
    a b c | same
    0 0 0 | 1
}
`;

/** Takes seconds to compile. */
const LARGE = HARD.split("\n\n")[0].replaceAll("[10]", "[32]");

const here = served({ "latch.nb": LATCH, "hard.nb": HARD, "large.nb": LARGE }, "latch.nb");
const at = name => `${here.program.address}#${name}`;
const shows = (page, name) => page.waitForFunction(want => document.querySelector(".file").textContent === want, name);

/** Ends something by a click, within 0.3 s. */
async function stops(t, what, page, selector, gone) {
  const took = await page.evaluate(
    ([button, work]) =>
      new Promise(done => {
        const begun = performance.now();
        const look = () => document.querySelector(work) === null && done(performance.now() - begun);
        new MutationObserver(look).observe(document.body, { subtree: true, childList: true, attributes: true });
        document.querySelector(button).click();
        look();
      }),
    [selector, gone],
  );
  within(t, `${what} stopped`, took, 300);
  assert.ok(took < 300);
}

const COMPILING = '.swarm .status[data-state="compiling"]';

test("while a large circuit is compiled other programs open, and Stop ends it", async t => {
  const page = await visit(here.program.url);
  await walking(page);
  await page.locator("[data-do=open]").click();
  await page.locator('.files [data-open="large.nb"]').click();
  await shows(page, "large.nb");
  await page.locator(COMPILING).waitFor();
  // The robots of the program before are not taken for those of this one, and rest.
  await page.locator(".swarm.foreign").waitFor({ state: "attached" });
  const opacity = () =>
    page.evaluate(() => Number(getComputedStyle(document.querySelector(".swarm > .scene")).opacity));
  await page.waitForTimeout(800);
  assert.ok((await opacity()) < 0.5);
  const cycles = () => page.locator(".cycle").textContent();
  const before = await cycles();
  await page.waitForTimeout(1000);
  assert.equal(await cycles(), before);
  await stops(t, "compiling", page, ".swarm .status button", COMPILING);
  await page.getByText("compiling was stopped").waitFor();
  // What compiles does not keep the list of programs waiting, nor another circuit.
  await page.reload();
  await page.locator(COMPILING).waitFor();
  const begun = Date.now();
  await page.locator("[data-do=open]").click();
  await page.locator('.files [data-open="latch.nb"]').first().click();
  await shows(page, "latch.nb");
  await walking(page);
  assert.ok(Date.now() - begun < 10_000, `${Date.now() - begun} ms`);
  assert.ok((await opacity()) === 1);
  await page.leave();
});

test("digits can be drawn on soon, and what they are is said before the robots show it", async t => {
  const page = await visit(at("digits.nb"));
  await page.locator(".drawn").waitFor();
  // The site has it compiled; a program compiles it.
  within(t, "the image", await page.evaluate(() => performance.now()), SITE === undefined ? Infinity : 3000);
  const said = () => page.locator(".logic").textContent();
  const before = await said();
  // A one.
  for (const pixel of [60, 59, 52, 51, 44, 43, 36, 35, 28, 27, 20, 19, 12, 11, 4, 3]) {
    await page.locator(`[data-pixel="pixels[${pixel}]"]`).click();
  }
  await page.getByText(/^soon digit = 1$/).waitFor();
  assert.notEqual(await said(), before);
  await page.leave();
});

test("proofs and tests stop at once, and what was found stays", async t => {
  const page = await visit(at("hard.nb"));
  await shows(page, "hard.nb");
  await page.locator("#tab-tests").click();
  await page.locator(".test [data-do=logic]").click();
  await page.getByText("✓ passes as logic").waitFor();
  await page.locator("[data-do=prove]").click();
  await page.locator("[data-claim][data-state=running]").waitFor();
  await page.waitForTimeout(1500);
  await stops(t, "the proof", page, "[data-claim] [data-do=stop]", "[data-claim][data-state=running]");
  assert.equal(await page.getByText("✓ passes as logic").count(), 1);
  await page.getByText("stopped", { exact: true }).waitFor();
  await page.locator("[data-do=open]").click();
  await page.locator('.files [data-open="computer.nb"]').click();
  await shows(page, "computer.nb");
  await page.locator(".test [data-do=physics]").first().click();
  await page.locator(".test[data-state=running] tr[data-row]").first().waitFor();
  await stops(t, "the test", page, ".test [data-do=stop]", ".test[data-state=running]");
  await page.locator(".test[data-state=failed] tr[data-row]").first().waitFor();
  await page.leave();
});

test("an evolution stops at once", async t => {
  const page = await visit(here.program.url);
  await walking(page);
  await page.locator("#tab-robots").click();
  await page.locator("[data-robot=nand_5x5] [data-do=design]").first().click();
  await page.locator("[data-do=evolve]").click();
  const running = ".row:has([data-do=evolve]) progress:not([hidden])";
  await page.locator(running).waitFor();
  await page.waitForTimeout(2000);
  await stops(t, "the evolution", page, "[data-do=evolve]", running);
  await page.leave();
});

/** In a document: counts what it draws and what its timers do. */
function count() {
  window.done = 0;
  for (const name of ["requestAnimationFrame", "setTimeout", "setInterval"]) {
    const own = window[name];
    window[name] = (work, ...more) =>
      own(
        (...given) => {
          window.done += 1;
          work(...given);
        },
        ...more,
      );
  }
}

test("a page that is paused does nothing", async () => {
  const page = await visit(here.program.url, { script: count });
  await walking(page);
  await page.locator(".controls [data-do=play]").click();
  await page.waitForTimeout(8000);
  const before = await page.evaluate(() => window.done);
  const spends = BROWSER === "chromium" ? await meter(page) : () => 0;
  const from = await spends();
  await page.waitForTimeout(5000);
  const spent = (await spends()) - from;
  assert.ok(spent < 0.1, `${spent} s in 5 s`);
  const did = (await page.evaluate(() => window.done)) - before;
  assert.ok(did <= 5, `${did} timers and drawings in 5 s`);
  await page.leave();
});

/** The seconds of CPU that the page has used, as Chromium counts them. */
async function meter(page) {
  const client = await page.context().newCDPSession(page);
  await client.send("Performance.enable");
  return async () =>
    (await client.send("Performance.getMetrics")).metrics.find(({ name }) => name === "TaskDuration").value;
}
