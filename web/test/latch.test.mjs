// The latch, live: its inputs are flipped with the mouse, and its lamps are read.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { closeBrowser, cycle, cyclesLater, lamp, setInput, visit, walking } from "./browser.mjs";
import { LATCH, folderWith, play } from "./program.mjs";

let place, program, page;

before(async () => {
  place = folderWith({ "latch.nb": LATCH });
  program = await play(place.folder, "latch.nb");
  page = await visit(program.url);
});

after(async () => {
  await page?.leave();
  await closeBrowser();
  await program?.stop();
  place?.remove();
});

test("the page opens with the file, compiled and walking", async () => {
  await walking(page);
  assert.equal(await page.locator(".file").textContent(), "latch.nb");
  assert.match(await page.locator(".swarm .status").first().textContent(), /^5 robots, settles within \d+ cycles$/);
  assert.ok(await page.locator(".hint").isVisible());
});

test("the lamps follow the inputs in all patterns", async () => {
  await page.locator(".speed").selectOption("16×");
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
    await setInput(page, "d", d);
    await setInput(page, "e", e);
    await cyclesLater(page, 24);
    assert.deepEqual([await lamp(page, "q"), await lamp(page, "nq")], [q, 1 - q], `d ${d}, e ${e}`);
  }
  assert.ok(await page.locator(".hint").isHidden());
});

test("pause, step, rewind and reset", async () => {
  await page.locator("[data-do=play]").click();
  // No rate is shown once the server has said that it is paused.
  await page.waitForFunction(() => document.querySelector(".rate").textContent === "");
  const stopped = await cycle(page);
  await page.locator("[data-do=step]").click();
  await page.waitForFunction(now => document.querySelector(".cycle").textContent === `cycle ${now}`, stopped + 1);
  const slider = page.locator(".rewind");
  await slider.fill("5");
  await page.waitForFunction(
    last => document.querySelector(".cycle").textContent === `cycle 5 of ${last}`,
    stopped + 1,
  );
  await page.locator("[data-do=step]").click();
  await page.waitForFunction(() => document.querySelector(".cycle").textContent === "cycle 6");
  await page.locator("[data-do=reset]").click();
  await page.waitForFunction(() => document.querySelector(".cycle").textContent === "cycle 0");
});

test("an automatic clock changes its input", async () => {
  await page.locator(".clock summary").click();
  await page.locator(".clock select").selectOption({ label: "d" });
  await page.locator(".clock input").fill("6");
  await page.locator("[data-do=clock]").click();
  await page.locator("[data-do=play]").click();
  await page.getByText("Clock: d every 6").waitFor();
  const input = value => page.locator(`button[data-input="d"][aria-checked="${value}"]`);
  await input(true).waitFor();
  await input(false).waitFor();
  await input(true).waitFor();
  await page.locator(".clock summary").click();
  await page.locator("[data-do=clock]").click();
  await page.locator("[data-do=clock][aria-pressed=false]").waitFor();
});

test("what is pointed at is marked in all views, and a robot can be followed alone", async () => {
  await page.locator("body").press("Escape");
  await page.locator('.schematic [data-id="cell-0"]').hover();
  await page.locator('.schematic [data-id="cell-0"].pointed').waitFor();
  assert.match(await page.locator(".inspector .line").textContent(), /NOT a \(not_7x7\) senses d = [01]/);
  await page.locator('.schematic [data-id="cell-0"]').click();
  await page.locator(".inspector .facts:not([hidden])").waitFor();
  await page.locator("[data-do=all]").click();
  await page.locator(".inspector .facts").waitFor({ state: "hidden" });
});

test("every kind of file can be taken away", async () => {
  const kinds = ["nb", "schematic", "svg", "csv", "vcd", "png", "page", "gif"];
  await page.locator(".take summary").click();
  for (const kind of kinds) {
    const [download] = await Promise.all([page.waitForEvent("download"), page.locator(`[data-take=${kind}]`).click()]);
    assert.equal(await download.failure(), null, kind);
    assert.ok(download.suggestedFilename().length > 3);
  }
});
