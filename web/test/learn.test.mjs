// A lesson is done by doing it.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { closeBrowser, setInput, visit, walking } from "./browser.mjs";
import { LATCH, folderWith, play } from "./program.mjs";

let place, program, page;

before(async () => {
  place = folderWith({ "latch.nb": LATCH });
  program = await play(place.folder, "latch.nb");
  page = await visit(program.url);
  await walking(page);
});

after(async () => {
  await page?.leave();
  await closeBrowser();
  await program?.stop();
  place?.remove();
});

const done = count =>
  page
    .locator('.strip li[data-done="true"]')
    .nth(count - 1)
    .waitFor();

test("the lesson on the latch is finished by using the latch as a memory", async () => {
  await page.locator("#tab-learn").click();
  assert.equal(await page.locator(".lesson").count(), 8);
  await page.locator("[data-lesson=latch] [data-do=begin]").click();
  await page.waitForFunction(() => document.querySelector(".file").textContent === "lesson_latch.nb");
  await page.locator(".speed").selectOption("4×");
  await setInput(page, "d", 1);
  await setInput(page, "e", 1);
  await done(1);
  await setInput(page, "e", 0);
  await done(2);
  await setInput(page, "d", 0);
  await done(3);
  await page.locator('.strip[data-finished="true"]').waitFor();
});

test("the progress is remembered", async () => {
  await page.reload();
  await page.locator("#tab-learn").click();
  await page.locator('[data-lesson="latch"][data-finished="true"]').waitFor();
  assert.equal(await page.locator('[data-finished="true"].lesson').count(), 1);
});

test("the lesson on a gate", async () => {
  await page.locator("[data-lesson=gate] [data-do=begin]").click();
  await page.waitForFunction(() => document.querySelector(".file").textContent === "lesson_gate.nb");
  await page.locator('button[data-input="a"]').waitFor();
  await page.locator(".speed").selectOption("4×");
  await setInput(page, "a", 1);
  await done(1);
  await setInput(page, "a", 0);
  await page.locator("[data-do=next]").waitFor();
});
