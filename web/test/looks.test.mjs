// The page on a phone, on a projector, in the dark, and for someone who asks for stillness.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { closeBrowser, cycle, visit, walking } from "./browser.mjs";
import { LATCH, folderWith, play } from "./program.mjs";

let place, program;

before(async () => {
  place = folderWith({ "latch.nb": LATCH });
  program = await play(place.folder, "latch.nb");
});

after(async () => {
  await closeBrowser();
  await program?.stop();
  place?.remove();
});

const TABS = ["swarm", "tests", "robots", "learn"];

test("a phone shows everything in its width", async () => {
  const page = await visit(program.url, { viewport: { width: 360, height: 740 } });
  await walking(page);
  for (const tab of TABS) {
    await page.locator(`#tab-${tab}`).click();
    const width = await page.evaluate(() => {
      const cards = [...document.querySelectorAll(".card, .welcome")].map(card => card.getBoundingClientRect().right);
      return Math.max(document.documentElement.scrollWidth, ...cards);
    });
    assert.ok(width <= 360, `${tab} is ${width} wide`);
    assert.equal(await page.locator(".welcome").isVisible(), tab === "swarm", "what it says is about the swarm");
  }
  await page.leave();
});

test("a card of a robot has all that it says in itself", async () => {
  const page = await visit(program.url, { viewport: { width: 1366, height: 768 } });
  await page.locator("#tab-robots").click();
  await page.locator(".robot.card").first().waitFor();
  const outside = await page.locator(".robot.card").evaluateAll(cards =>
    cards.flatMap(card => {
      const { right, bottom } = card.getBoundingClientRect();
      const boxes = [...card.querySelectorAll("*")].map(part => [part.outerHTML, part.getBoundingClientRect()]);
      return boxes.filter(([, box]) => box.right > right || box.bottom > bottom).map(([text]) => text.slice(0, 80));
    }),
  );
  assert.deepEqual(outside, []);
  await page.leave();
});

test("nothing moves on a phone when the first switch is flipped", async () => {
  const page = await visit(program.url, { viewport: { width: 390, height: 844 } });
  await walking(page);
  const tops = () =>
    page.evaluate(() =>
      [".ports", ".controls", ".stage", ".diagrams"].map(one =>
        Math.round(document.querySelector(one).getBoundingClientRect().top),
      ),
    );
  const before = await tops();
  await page.locator("[data-input=d]").click();
  await page.locator("[data-input=d][aria-checked=true]").waitFor();
  await page.waitForTimeout(500);
  assert.deepEqual(await tops(), before);
  await page.leave();
});

test("large type for a projector, and light and dark, are remembered", async () => {
  const page = await visit(program.url, { colorScheme: "dark" });
  await walking(page);
  const size = () => page.evaluate(() => parseFloat(getComputedStyle(document.body).fontSize));
  const paper = () =>
    page.evaluate(() => getComputedStyle(document.documentElement).getPropertyValue("--paper").trim());
  const [small, dark] = [await size(), await paper()];
  await page.locator("[data-do=projector]").click();
  await page.locator("[data-do=theme]").click();
  assert.ok((await size()) >= 1.3 * small);
  assert.notEqual(await paper(), dark);
  await page.reload();
  await walking(page);
  assert.ok((await size()) >= 1.3 * small);
  assert.notEqual(await paper(), dark);
  await page.leave();
});

test("without motion the swarm waits to be asked", async () => {
  const page = await visit(program.url, { reducedMotion: "reduce" });
  await page.waitForFunction(() => document.querySelector(".cycle").textContent === "cycle 0");
  assert.equal(await page.locator("[data-do=play]").getAttribute("data-running"), "false");
  await page.locator("[data-do=step]").click();
  await page.waitForFunction(() => document.querySelector(".cycle").textContent === "cycle 1");
  assert.equal(await cycle(page), 1);
  await page.leave();
});

test("the keyboard reaches what the mouse does", async () => {
  const page = await visit(program.url);
  await walking(page);
  await page.locator('button[data-input="d"]').focus();
  await page.keyboard.press("Space");
  await page.locator('button[data-input="d"][aria-checked="true"]').waitFor();
  await page.locator("#tab-swarm").focus();
  await page.keyboard.press("ArrowRight");
  await page.locator("#tab-tests[aria-selected=true]").waitFor();
  await page.keyboard.press("ArrowLeft");
  await page.locator(".stage").focus();
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("Enter");
  await page.locator(".scene .facts:not([hidden])").waitFor();
  // What is said of a robot does not cover it.
  const [stage, facts] = [
    await page.locator(".stage").boundingBox(),
    await page.locator(".scene .facts").boundingBox(),
  ];
  assert.ok(stage.x + stage.width <= facts.x, `${JSON.stringify(stage)} ${JSON.stringify(facts)}`);
  await page.keyboard.press("Escape");
  await page.locator(".scene .facts").waitFor({ state: "hidden" });
  // The schematic is one stop of the tab key, however many robots it has; arrows go from robot to robot.
  const focused = () => page.evaluate(() => document.activeElement.closest("[data-id]")?.dataset.id ?? "");
  await page.locator('.schematic [tabindex="0"]').focus();
  const first = await focused();
  await page.keyboard.press("ArrowRight");
  assert.notEqual(await focused(), first);
  assert.match(await focused(), /^cell-/);
  await page.keyboard.press("Tab");
  assert.equal(await focused(), "");
  await page.leave();
});

test("a circuit without a state has its truth table beside the robots", async () => {
  const page = await visit(program.url);
  await walking(page);
  assert.ok(await page.locator("[data-do=truth]").isHidden(), "a latch has a state");
  await page.locator("[data-do=open]").click();
  await page.locator('[data-open="half_adder.nb"]').click();
  await page.locator("[data-do=truth]").click();
  const rows = await page.locator(".table tbody tr").evaluateAll(all => all.map(row => row.textContent.slice(1)));
  assert.deepEqual(rows, ["0000", "0110", "1010", "1101"]);
  await page.locator('.table [data-row="11"] button').click();
  await page.locator('.table [data-row="11"][aria-current]').waitFor();
  await page.locator('[data-input="a"][aria-checked="true"]').waitFor();
  await page.locator('.table [data-row="10"] td').last().click();
  await page.locator('.table [data-row="10"][aria-current]').waitFor();
  await page.locator('[data-input="b"][aria-checked="false"]').waitFor();
  await page.leave();
});
