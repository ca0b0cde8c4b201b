// Where one is: addresses of lessons and their steps, Back and Forward, reloads, and the page on paper.

import assert from "node:assert/strict";
import { test } from "node:test";

import { onlyChromium, setInput, typeProgram, visit, walking } from "./browser.mjs";
import { compiled, done } from "./lessons.mjs";
import { served } from "./opened.mjs";
import { LATCH } from "./program.mjs";

const MATERIAL = "material slow { kind: actuator, drive: sine, period: 168 steps, phase: 0 deg, range: 0.6..1.6 }\n";

const BROKEN = "circuit gate(a) -> (q) {\n    q = not b\n}\n";

const here = served({ "latch.nb": LATCH, "material.nb": MATERIAL, "broken.nb": BROKEN }, "latch.nb");

const at = fragment => `${here.program.address}#${fragment}`;
const file = (page, name) => page.waitForFunction(want => document.querySelector(".file").textContent === want, name);
const step = (page, number) => page.locator(`.strip .steps li:nth-child(${number}) a[aria-current="step"]`).waitFor();
const tab = (page, name) => page.locator(`#tab-${name}[aria-selected=true]`).waitFor();
const address = (page, fragment) => page.waitForFunction(want => location.hash === `#${want}`, fragment);

test("an address opens a step of a lesson, and Back and Forward go through the steps", async () => {
  const page = await visit(at("lesson/latch/2"));
  await file(page, "lesson_latch.nb");
  await step(page, 2);
  await tab(page, "swarm");
  await compiled(page);
  assert.equal(await page.locator('.strip .steps li[data-done="true"]').count(), 0, "no step is done by a link");
  await page.locator(".strip .steps li:nth-child(1) a").click();
  await step(page, 1);
  await page.locator(".speed").selectOption("16×");
  await setInput(page, "d", 1);
  await setInput(page, "e", 1);
  // A step that is done leads on.
  await done(page, 1);
  await address(page, "lesson/latch/2");
  await page.goBack();
  await address(page, "lesson/latch/1");
  await step(page, 1);
  await page.goForward();
  await step(page, 2);
  await setInput(page, "e", 0);
  await address(page, "lesson/latch/3");
  await page.leave();
});

test("program, draft and step belong together, also after a reload", async () => {
  const page = await visit(at("lesson/and/1"));
  await file(page, "lesson_and.nb");
  await compiled(page);
  await typeProgram(page, "circuit both(a, b) -> (q) {\n    q = a or b\n}\n");
  await page.locator('.file[data-unsaved="true"]').waitFor();
  await page.locator("#tab-tests").click();
  await page.reload();
  await file(page, "lesson_and.nb");
  await page.locator(".cm-content").getByText("a or b").waitFor();
  await step(page, 1);
  await tab(page, "tests");
  // Another program is no part of the lesson, which is a click away.
  await page.locator("[data-do=open]").click();
  await page.locator('[data-open="latch.nb"]').first().click();
  await file(page, "latch.nb");
  await address(page, "latch.nb");
  await page.locator(".strip [data-do=resume]").click();
  await file(page, "lesson_and.nb");
  await page.locator(".cm-content").getByText("a or b").waitFor();
  await page.goBack();
  await file(page, "latch.nb");
  await page.leave();
});

test("Back and Forward go through files and views", async () => {
  const page = await visit(here.program.url);
  await walking(page);
  await page.locator("#tab-tests").click();
  await page.locator("#tab-robots").click();
  await page.locator("[data-do=open]").click();
  await page.getByLabel("Name of the new file").fill("other");
  await page.locator("[data-do=new]").click();
  await file(page, "other.nb");
  await page.goBack();
  await file(page, "latch.nb");
  await tab(page, "robots");
  await page.goBack();
  await tab(page, "tests");
  await page.goBack();
  await tab(page, "swarm");
  await page.goForward();
  await tab(page, "tests");
  await page.reload();
  await tab(page, "tests");
  await page.leave();
});

test("a program without a circuit says so, and shows no robots of another", async () => {
  const page = await visit(here.program.url);
  await walking(page);
  await page.locator("[data-do=open]").click();
  await page.locator('.files [data-open="material.nb"]').click();
  await file(page, "material.nb");
  const says = text => page.locator(".swarm .status", { hasText: text }).waitFor();
  await says(/^The program has no circuit$/);
  await page.locator(".stage").waitFor({ state: "hidden" });
  await typeProgram(page, "circuit gate(a, b) -> (q) {\n    q = a and b\n}\n");
  await says(/^1 robot/);
  await page.locator(".stage").waitFor();
  await typeProgram(page, MATERIAL);
  await says(/^The program has no circuit; these robots are from before$/);
  await page.locator(".stage").waitFor();
  await page.leave();
});

test("a program that opens with an error says so, and shows no robots until it is mended", async () => {
  const page = await visit(at("broken.nb"));
  await page.locator(".swarm .status", { hasText: /^1 error in the program$/ }).waitFor();
  await page.locator(".stage").waitFor({ state: "hidden" });
  await typeProgram(page, LATCH);
  await walking(page);
  await page.locator(".stage").waitFor();
  await page.leave();
});

test("an address of nothing says so, and opens the page as usual", async () => {
  for (const name of ["lesson/no-such-lesson/1", "nothere.nb"]) {
    const page = await visit(at(name));
    await walking(page);
    await file(page, "latch.nb");
    await page.getByText(`There is no ${name} here.`).waitFor();
    await page.leave();
  }
});

test("a step that does not count says which condition is open, and why", async () => {
  const page = await visit(at("lesson/latch/1"));
  await compiled(page);
  const missing = page.locator(".strip .missing li");
  assert.equal(await missing.count(), 0);
  await page.locator(".strip [data-do=why]").click();
  await missing.getByText(/the swarm keeps d = 1, e = 1, q = 1 until it has settled – /).waitFor();
  await setInput(page, "d", 1);
  await missing.getByText(/– now e = 0, q = 0/).waitFor();
  await page.leave();
});

/** How much of an element can be seen. */
const visible = (page, selector) =>
  page.locator(selector).evaluate(host => {
    const { top, bottom } = host.getBoundingClientRect();
    return Math.max(0, Math.min(innerHeight, bottom) - Math.max(0, top)) / (bottom - top);
  });

for (const [look, options] of [
  ["light", {}],
  ["dark", { colorScheme: "dark" }],
]) {
  test(`on a low screen a lesson leaves room for inputs, outputs and waveform: ${look}`, async () => {
    const page = await visit(at("lesson/machine/1"), { viewport: { width: 1366, height: 650 }, ...options });
    await compiled(page);
    assert.ok((await page.locator(".strip .about").getAttribute("open")) !== null, "a new lesson begins with its text");
    for (const fold of [false, true]) {
      if (fold) {
        await page.locator(".strip [data-do=about]").click();
      }
      for (const part of [".inputs", ".outputs", ".controls", ".stage", ".schematic", ".waveform"]) {
        assert.equal(await visible(page, part), 1, `${part}, ${fold ? "folded" : "unfolded"}`);
      }
      assert.ok((await page.locator(".waveform").boundingBox()).height >= 50);
    }
    // What was read stays folded away.
    await page.reload();
    await compiled(page);
    assert.equal(await page.locator(".strip .about").getAttribute("open"), null);
    await page.leave();
  });
}

test("for a projector, circuit and waveform are larger", async () => {
  const page = await visit(here.program.url);
  await walking(page);
  const sizes = async () =>
    Promise.all([".schematic", ".waveform"].map(async one => (await page.locator(one).boundingBox()).height));
  const before = await sizes();
  await page.locator("[data-do=projector]").click();
  await page.waitForFunction(height => document.querySelector(".waveform").clientHeight > height, before[1]);
  const after = await sizes();
  after.forEach((size, i) => assert.ok(size >= 1.2 * before[i], `${before[i]} and then ${size}`));
  await page.leave();
});

const paper = { skip: onlyChromium("what it prints") };

test("on paper there is the program, its circuit and its results, and nothing to press", paper, async () => {
  const page = await visit(here.program.url);
  await walking(page);
  await page.locator("#tab-tests").click();
  await page.locator("[data-do=all-logic]").click();
  await page.getByText("✓ passes as logic").waitFor();
  const pdf = await page.pdf();
  assert.equal(pdf.subarray(0, 4).toString(), "%PDF");
  // As the browser does before it prints.
  await page.emulateMedia({ media: "print" });
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  const text = await page.locator(".paper").innerText();
  for (const part of ["latch.nb", "circuit d_latch(d, e) -> (q, nq) {", "5 robots", "passes as logic", "q = "]) {
    assert.ok(text.includes(part), `${part} in ${text}`);
  }
  assert.ok((await page.locator(".paper .drawing").boundingBox()).height > 50);
  assert.equal(await page.locator(".page").isVisible(), false);
  await page.evaluate(() => dispatchEvent(new Event("afterprint")));
  assert.equal(await page.locator(".paper").innerText(), "");
  await page.leave();
});
