// Lessons on a phone, by keyboard alone, and as a screen reader finds them.

import assert from "node:assert/strict";
import { test } from "node:test";

import { BROWSER, onlyChromium, visit, walking } from "./browser.mjs";
import { compiled, done } from "./lessons.mjs";
import { served } from "./opened.mjs";
import { LATCH, SITE } from "./program.mjs";

const here = served({ "latch.nb": LATCH }, "latch.nb", { more: ["--class"] });

/** Firefox gets the touches of its protocol, and makes no clicks of them. */
const tap = one => (BROWSER === "firefox" ? one.click() : one.tap());

test("a lesson is done on a phone by touch, and nothing is wider than its screen", async () => {
  const page = await visit(here.program.url, { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
  await walking(page);
  const fits = async () => assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 390);
  await tap(page.locator("#tab-learn"));
  await fits();
  await tap(page.locator("[data-lesson=gate] [data-do=begin]"));
  await page.waitForFunction(() => document.querySelector(".file").textContent === "lesson_gate.nb");
  await compiled(page);
  await page.locator(".speed").selectOption("16×");
  await tap(page.locator(".strip [data-do=hint]"));
  assert.equal(await page.locator(".strip .hints li").count(), 1);
  await fits();
  // What can be touched is large enough for a finger.
  for (const control of await page.locator(".strip button:visible").all()) {
    const { width, height } = await control.boundingBox();
    assert.ok(Math.min(width, height) >= 24, `${await control.textContent()} is ${width} x ${height}`);
  }
  for (const [step, count] of [
    [1, 1],
    [0, 2],
  ]) {
    await tap(page.locator('button[data-input="a"]'));
    await page.locator(`button[data-input="a"][aria-checked="${step === 1}"]`).waitFor();
    await done(page, count);
  }
  await fits();
  await tap(page.locator(".strip [data-do=next]"));
  await page.waitForFunction(() => document.querySelector(".file").textContent === "lesson_stimuli.nb");
  await page.leave();
});

test("a lesson is done with the keyboard alone", async () => {
  const page = await visit(here.program.url);
  await walking(page);
  /** Presses the tab key until the element with this selector has the focus. */
  const reach = async (selector, key = "Tab") => {
    for (let presses = 0; presses < 200; presses++) {
      if (await page.evaluate(wanted => document.activeElement?.matches(wanted) ?? false, selector)) {
        return;
      }
      // In the editor the tab key indents, until Esc is pressed.
      if (await page.evaluate(() => document.activeElement?.shadowRoot !== null)) {
        await page.keyboard.press("Escape");
      }
      await page.keyboard.press(key);
    }
    assert.fail(`the tab key does not reach ${selector}`);
  };
  await reach('[role=tab][aria-selected="true"]');
  while ((await page.locator("#tab-learn").getAttribute("aria-selected")) !== "true") {
    await page.keyboard.press("ArrowRight");
  }
  await reach("[data-lesson=gate] [data-do=begin]");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => document.querySelector(".file").textContent === "lesson_gate.nb");
  await compiled(page);
  await reach(".strip [data-do=hint]", "Shift+Tab");
  await page.keyboard.press("Enter");
  await page.keyboard.press("Space");
  assert.equal(await page.locator(".strip .hints li").count(), 2);
  await reach(".speed");
  await page.keyboard.press("End");
  await page.keyboard.press("ArrowUp");
  await reach('button[data-input="a"]', "Shift+Tab");
  await page.keyboard.press("Space");
  await done(page, 1);
  await page.keyboard.press("Space");
  await done(page, 2);
  await reach(".strip [data-do=next]", "Shift+Tab");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => document.querySelector(".file").textContent === "lesson_stimuli.nb");
  await reach(".strip [data-do=leave]", "Shift+Tab");
  // Without a window, Firefox may take the focus from its page, and then lets no key press a button.
  await (BROWSER === "firefox" ? page.locator(".strip [data-do=leave]").click() : page.keyboard.press("Enter"));
  await page.locator(".strip").waitFor({ state: "hidden" });
  await page.leave();
});

/** The nodes of the accessibility tree below an element that can be used or that have a heading's role. */
async function controls(page, selector) {
  const session = await page.context().newCDPSession(page);
  await session.send("Accessibility.enable");
  const { root } = await session.send("DOM.getDocument");
  const { nodeId } = await session.send("DOM.querySelector", { nodeId: root.nodeId, selector });
  const { node } = await session.send("DOM.describeNode", { nodeId });
  const { nodes } = await session.send("Accessibility.queryAXTree", { backendNodeId: node.backendNodeId });
  const kinds = [
    "button",
    "textbox",
    "link",
    "checkbox",
    "switch",
    "combobox",
    "DisclosureTriangle",
    "heading",
    "image",
  ];
  return nodes
    .filter(one => !one.ignored && kinds.includes(one.role?.value))
    .map(one => `${one.role.value}: ${one.name?.value ?? ""}`);
}

const heard = { skip: onlyChromium("its tree for screen readers") };

test("every control of the lessons has a role and a name", heard, async () => {
  const page = await visit(here.program.url);
  await walking(page);
  await page.locator("#tab-learn").click();
  const lessons = await controls(page, "#panel-learn");
  // A browser tab has no class.
  const course = ["heading: This is a class", "textbox: Your name in the class", "button: Join the class"];
  course.forEach(control => assert.equal(lessons.includes(control), SITE === undefined, lessons.join("\n")));
  assert.equal(lessons.filter(name => name.startsWith("button: Begin: ")).length, 24);
  assert.ok(lessons.includes("heading: A robot is a gate"));
  assert.equal(new Set(lessons.filter(name => name.startsWith("button: Begin: "))).size, 24);
  await page.locator("[data-lesson=stimuli] [data-do=begin]").click();
  await page.waitForFunction(() => document.querySelector(".file").textContent === "lesson_stimuli.nb");
  await page.locator(".strip [data-do=hint]").click();
  const strip = await controls(page, ".strip");
  assert.deepEqual(strip.sort(), [
    "DisclosureTriangle: Explanation",
    "button: Another hint (2 of 3)",
    "button: Leave the lesson",
    "button: Start again",
    "button: What is missing?",
    "heading: Two stimuli 2 of 24",
    "link: Step 1, to do",
    "link: Step 2, to do",
  ]);
  assert.equal(await page.getByRole("complementary", { name: "Lesson" }).count(), 1);
  for (const all of [lessons, strip]) {
    assert.deepEqual(
      all.filter(name => name.endsWith(": ")),
      [],
    );
  }
  await page.leave();
});
