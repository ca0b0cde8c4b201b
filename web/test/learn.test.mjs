// A lesson is done by doing it.

import assert from "node:assert/strict";
import { test } from "node:test";

import { cyclesLater, setInput, typeProgram } from "./browser.mjs";
import { opened } from "./opened.mjs";
import { LATCH } from "./program.mjs";

const here = opened({ "latch.nb": LATCH }, "latch.nb");

const done = count =>
  here.page
    .locator('.strip li[data-done="true"]')
    .nth(count - 1)
    .waitFor();

test("the lesson on the latch is finished by using the latch as a memory", async () => {
  await here.page.locator("#tab-learn").click();
  assert.equal(await here.page.locator(".lesson").count(), 8);
  await here.page.locator("[data-lesson=latch] [data-do=begin]").click();
  await here.page.waitForFunction(() => document.querySelector(".file").textContent === "lesson_latch.nb");
  await here.page.locator(".speed").selectOption("4×");
  await setInput(here.page, "d", 1);
  await setInput(here.page, "e", 1);
  await done(1);
  await setInput(here.page, "e", 0);
  await done(2);
  await setInput(here.page, "d", 0);
  await done(3);
  await here.page.locator('.strip[data-finished="true"]').waitFor();
});

test("a lesson is begun again from its start, and runs, whatever was there before", async () => {
  await here.page.locator("#tab-swarm").click();
  await setInput(here.page, "d", 1);
  await setInput(here.page, "e", 1);
  await here.page.locator('[data-lamp="q"][data-value="1"]').waitFor();
  await here.page.locator("[data-do=play][data-running=true]").click();
  await here.page.locator("#tab-learn").click();
  await here.page.locator("[data-lesson=latch] [data-do=begin]").click();
  await here.page.locator("[data-do=play][data-running=true]").waitFor();
  await cyclesLater(here.page, 8);
  assert.equal(await here.page.locator('.strip li[data-done="true"]').count(), 0);
  assert.equal(await here.page.locator('button[data-input="d"]').getAttribute("aria-checked"), "false");
});

test("the program of a lesson can be had back", async () => {
  await here.page.locator(".strip [data-do=restore]").waitFor({ state: "hidden" });
  await typeProgram(here.page, "circuit broken(a) -> (q) {\n    q = b\n}\n");
  await here.page.locator('.swarm .status[data-state="errors"]').waitFor();
  await here.page.locator(".strip [data-do=restore]").click();
  await here.page.locator('.swarm .status[data-state="ready"]').waitFor();
  assert.match(await here.page.locator(".cm-content").textContent(), /circuit d_latch/);
  await setInput(here.page, "d", 1);
  await setInput(here.page, "e", 1);
  await done(1);
  await setInput(here.page, "e", 0);
  await done(2);
  await setInput(here.page, "d", 0);
  await here.page.locator('.strip[data-finished="true"]').waitFor();
});

test("the progress is remembered", async () => {
  await here.page.reload();
  await here.page.locator("#tab-learn").click();
  await here.page.locator('[data-lesson="latch"][data-finished="true"]').waitFor();
  assert.equal(await here.page.locator('[data-finished="true"].lesson').count(), 1);
});

// The other lessons in their order, each left by the button that leads to the next.

async function next(name) {
  await here.page.locator('.strip[data-finished="true"]').waitFor();
  await here.page.locator(".strip [data-do=next]").click();
  await opens(name);
}

async function opens(name) {
  await here.page.waitForFunction(file => document.querySelector(".file").textContent === file, `lesson_${name}.nb`);
  await here.page.locator(".speed").selectOption("4×");
}

async function setNumber(name, value) {
  const input = here.page.locator(`input[data-input="${name}"]`);
  await input.fill(String(value));
  await input.press("Enter");
}

test("the lesson on a gate", async () => {
  await here.page.locator("[data-lesson=gate] [data-do=begin]").click();
  await opens("gate");
  await setInput(here.page, "a", 1);
  await done(1);
  await setInput(here.page, "a", 0);
});

test("the lesson on two stimuli", async () => {
  await next("stimuli");
  await setInput(here.page, "a", 1);
  await setInput(here.page, "b", 1);
  await done(1);
  for (const [a, b] of [
    [1, 0],
    [0, 1],
    [0, 0],
  ]) {
    await setInput(here.page, "a", a);
    await setInput(here.page, "b", b);
    await cyclesLater(here.page, 12);
  }
});

test("the lesson on NAND", async () => {
  await next("nand");
  await setInput(here.page, "a", 1);
  await setInput(here.page, "b", 1);
  await done(1);
  await here.page.locator("#tab-robots").click();
  await here.page.locator('[data-robot="nand_5x5"] [data-do=design]').click();
  await done(2);
  await here.page.locator("[data-do=mirror]").click();
});

test("the lesson on an adder", async () => {
  await next("adder");
  await setNumber("a", 3);
  await setNumber("b", 2);
  await done(1);
  await here.page.locator("#tab-tests").click();
  assert.equal(await here.page.locator(".test .count").textContent(), "all inputs");
  await here.page.locator(".test [data-do=logic]").click();
});

test("the lesson on memory", async () => {
  await next("memory");
  for (const [name, value, step] of [
    ["set", 1, 1],
    ["set", 0, 2],
    ["reset", 1, 2],
  ]) {
    await setInput(here.page, name, value);
    await done(step);
  }
  await here.page.locator('[data-lamp="q"][data-value="0"]').waitFor();
  await setInput(here.page, "reset", 0);
  await done(3);
});

test("the lesson on evolution", async () => {
  await here.page.locator("#tab-learn").click();
  await here.page.locator("[data-lesson=evolution] [data-do=begin]").click();
  await here.page.locator("#tab-robots[aria-selected=true]").waitFor();
  await here.page.locator("[data-do=random]").click();
  await here.page.locator("[data-do=evolve]").click();
  await done(2);
  await here.page.locator(".niche:not(:disabled)").first().click();
  await done(3);
  await here.page.locator("[data-do=evolve]").click();
});

test("the lesson on a circuit of one's own", async () => {
  await next("own");
  // What was known of the text before counts no more, and errors are no step.
  await typeProgram(here.page, "circuit light(a) -> (q) {\n    q = b\n}\n");
  await here.page.locator('.swarm .status[data-state="errors"]').waitFor();
  assert.equal(await here.page.locator('.strip li[data-done="true"]').count(), 0);
  await typeProgram(
    here.page,
    'circuit light(a, b) -> (q) {\n    q = a xor b\n}\n\ntest light "two switches" {\n    a b | q\n    0 1 | 1\n    1 1 | 0\n}\n',
  );
  await done(1);
  await here.page.locator("#tab-tests").click();
  await here.page.locator(".test [data-do=logic]").click();
  await done(2);
  await here.page.locator("#tab-swarm").click();
  await setInput(here.page, "a", 1);
  await here.page.getByText("Well done. That was the last lesson.").waitFor();
  await here.page.locator("#tab-learn").click();
  assert.equal(await here.page.locator('[data-finished="true"].lesson').count(), 8);
});
