// The latch, live: its inputs are flipped with the mouse, and its lamps are read.

import assert from "node:assert/strict";
import { test } from "node:test";

import { cycle, cyclesLater, lamp, lampsShow, setInput, taken, typeNumber, walking } from "./browser.mjs";
import { opened } from "./opened.mjs";
import { LATCH } from "./program.mjs";

const here = opened({ "latch.nb": LATCH }, "latch.nb");

test("the page opens with the file, compiled and walking", async () => {
  await walking(here.page);
  assert.equal(await here.page.locator(".file").textContent(), "latch.nb");
  assert.match(
    await here.page.locator(".swarm .status").first().textContent(),
    /^5 robots, settles within \d+ cycles$/,
  );
});

test("the lamps follow the inputs in all patterns", async () => {
  await here.page.locator(".speed").selectOption("16×");
  const patterns = [
    [0, 1, 0],
    [1, 1, 1],
    [1, 0, 1],
    [0, 0, 1],
    [0, 1, 0],
    [0, 0, 0],
    [1, 0, 0],
    [1, 1, 1],
  ];
  for (const [d, e, q] of patterns) {
    await setInput(here.page, "d", d);
    await setInput(here.page, "e", e);
    // A busy page shows cycles that were made before the switch was flipped, so the lamps are waited for.
    await lampsShow(here.page, { q, nq: 1 - q });
    await cyclesLater(here.page, 24);
    assert.deepEqual([await lamp(here.page, "q"), await lamp(here.page, "nq")], [q, 1 - q], `d ${d}, e ${e}`);
  }
});

test("pause, step, rewind and reset", async () => {
  await here.page.locator("[data-do=play]").click();
  // No rate is shown once the server has said that it is paused.
  await here.page.waitForFunction(() => document.querySelector(".rate").textContent === "");
  const stopped = await cycle(here.page);
  await here.page.locator("[data-do=step]").click();
  await here.page.waitForFunction(now => document.querySelector(".cycle").textContent === `cycle ${now}`, stopped + 1);
  const slider = here.page.locator(".rewind");
  // Only the last thousand cycles are kept.
  await slider.fill(String(stopped - 5));
  await here.page.waitForFunction(
    now => document.querySelector(".cycle").textContent === `cycle ${now - 5} of ${now + 1}`,
    stopped,
  );
  await here.page.locator("[data-do=step]").click();
  await here.page.waitForFunction(now => document.querySelector(".cycle").textContent === `cycle ${now}`, stopped - 4);
  await here.page.locator("[data-do=reset]").click();
  await here.page.waitForFunction(() => document.querySelector(".cycle").textContent === "cycle 0");
});

test("a rewind takes over the inputs of its moment", async () => {
  await setInput(here.page, "d", 0);
  await setInput(here.page, "e", 0);
  await here.page.locator("[data-do=step]").click();
  await setInput(here.page, "d", 1);
  for (let i = 0; i < 3; i++) {
    await here.page.locator("[data-do=step]").click();
  }
  await here.page.waitForFunction(() => document.querySelector(".cycle").textContent === "cycle 4");
  const slider = here.page.locator(".rewind");
  for (let i = 0; i < 5; i++) {
    for (const [moment, d] of [
      [1, "false"],
      [3, "true"],
      [2, "true"],
    ]) {
      // As when the slider is dragged: each moment is asked for before the one before has come.
      await slider.fill("4");
      await slider.fill(String(moment));
      await here.page.waitForFunction(
        now => document.querySelector(".cycle").textContent === `cycle ${now} of 4`,
        moment,
      );
      assert.equal(await here.page.locator('button[data-input="d"]').getAttribute("aria-checked"), d, String(moment));
    }
  }
  await here.page.locator("[data-do=reset]").click();
  await here.page.waitForFunction(() => document.querySelector(".cycle").textContent === "cycle 0");
});

test("an automatic clock changes its input", async () => {
  await here.page.locator(".clock summary").click();
  await here.page.locator(".clock select").selectOption({ label: "d" });
  await typeNumber(here.page.locator(".clock input"), 6);
  await here.page.locator("[data-do=clock]").click();
  await here.page.locator("[data-do=play][data-running=true]").waitFor();
  await here.page.getByText("Clock: d every 6").waitFor();
  const input = value => here.page.locator(`button[data-input="d"][aria-checked="${value}"]`);
  await input(true).waitFor();
  await input(false).waitFor();
  await input(true).waitFor();
  await here.page.locator("[data-do=clock]").click();
  await here.page.locator("[data-do=clock][aria-pressed=false]").waitFor();
});

test("a run ends by itself after some cycles and clocks, and when an output has a value", async () => {
  const { page } = here;
  // The swarm may have gone on until the page saw the end, so it goes back: then no rate is shown any more.
  const rests = async () => {
    await page.locator("[data-do=play][data-running=false]").waitFor();
    await page.waitForFunction(() => document.querySelector(".rate").textContent === "");
  };
  await page.locator("[data-do=reset]").click();
  await page.locator(".speed").selectOption("max");
  await setInput(page, "e", 1);
  await setInput(page, "d", 1);
  await page.locator(".until summary").click();
  await typeNumber(page.getByLabel("How many"), 30);
  await page.locator("[data-do=until-cycles]").click();
  await page.waitForFunction(() => /^cycle 30\b/.test(document.querySelector(".cycle").textContent));
  await rests();
  await page.locator(".until summary").click();
  await page.getByLabel("Output or register").selectOption("nq");
  await page.locator("[data-do=until-value]").click();
  await page.getByText("Until nq is 1").waitFor();
  await setInput(page, "d", 0);
  await rests();
  await lampsShow(page, { nq: 1 });
  const before = await cycle(page);
  await page.locator(".until summary").click();
  await page.locator("[data-do=until-clocks]").click();
  await rests();
  const after = await cycle(page);
  assert.ok(after > before + 30 && after % 2 === before % 2);
  await page.locator(".clock summary").click();
  await page.locator("[data-do=clock][aria-pressed=true]").click();
  await page.locator(".speed").selectOption("16×");
  await page.locator("[data-do=play]").click();
});

test("what is pointed at is marked in all views, and a robot can be followed alone", async () => {
  await here.page.locator("body").press("Escape");
  await here.page.locator('.schematic [data-id="cell-0"]').hover();
  await here.page.locator('.schematic [data-id="cell-0"].pointed').waitFor();
  assert.match(await here.page.locator(".inspector .line").textContent(), /NOT a \(not_5x5\) senses d = [01]/);
  await here.page.locator('.schematic [data-id="cell-0"]').click();
  await here.page.locator(".scene .facts:not([hidden])").waitFor();
  await here.page.locator("[data-do=all]").click();
  await here.page.locator(".scene .facts").waitFor({ state: "hidden" });
});

test("every kind of file can be taken away", async () => {
  const kinds = ["nb", "schematic", "svg", "csv", "vcd", "png", "page", "gif", "recorded"];
  const names = new Set();
  await here.page.locator(".take summary").click();
  for (const kind of kinds) {
    const { name, bytes } = await taken(here.page, () => here.page.locator(`[data-take=${kind}]`).click());
    assert.ok(bytes.length > 0, kind);
    names.add(name);
  }
  assert.equal(names.size, kinds.length, [...names].join());
});
