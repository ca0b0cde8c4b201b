// The schematic: its texts can be read at any size, it is zoomed by keys, buttons and two fingers, and it is no picture
// for those who hear it.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";

import { closeBrowser, onlyChromium, visit } from "./browser.mjs";
import { folderWith, play } from "./program.mjs";

const gallery = name => readFileSync(new URL(`../../circuits/${name}.nb`, import.meta.url), "utf8");
const NAMES = ["latch", "counter", "traffic_light", "ripple_adder", "computer"];

let place, program;

before(async () => {
  place = folderWith(Object.fromEntries(NAMES.map(name => [`${name}.nb`, gallery(name)])));
  program = await play(place.folder, "latch.nb");
});

after(async () => {
  await closeBrowser();
  await program?.stop();
  place?.remove();
});

async function open(name, options) {
  const page = await visit(`${program.address}#${name}.nb`, options);
  await page.locator(".schematic svg[aria-label]").waitFor();
  await page.locator(".schematic svg text tspan").first().waitFor({ state: "attached" });
  return page;
}

/** The size in pixels of the smallest letters that are seen, and how many texts there are. */
function letters(page) {
  return page.evaluate(() => {
    const svg = document.querySelector(".schematic svg[aria-label]");
    const seen = [...svg.querySelectorAll("text")].filter(
      text => getComputedStyle(text).visibility === "visible" && text.textContent !== "",
    );
    const scale = svg.getScreenCTM().a;
    return {
      texts: seen.length,
      least: Math.min(...seen.map(text => parseFloat(getComputedStyle(text).fontSize) * scale)),
    };
  });
}

const crumbs = page => page.locator(".crumbs button").allTextContents();

test("letters have at least 11 pixels at any size and any distance", async () => {
  for (const [width, height] of [
    [1440, 900],
    [1366, 650],
    [360, 740],
  ]) {
    for (const name of NAMES) {
      const page = await open(name, { viewport: { width, height } });
      for (const key of ["0", "+", "+", "-", "-", "-", "-", "-"]) {
        await page.locator(".schematic").press(key);
        const { texts, least } = await letters(page);
        assert.ok(texts > 0 && least >= 11, `${name}, ${width} px, after ${key}: ${texts} texts of ${least} px`);
      }
      await page.leave();
    }
  }
});

/** What the gates of the schematic say, as it is seen. */
const gates = page =>
  page.locator('.schematic [data-id^="cell-"]').evaluateAll(all =>
    all.map(gate => {
      const text = gate.querySelector("text");
      return getComputedStyle(text).visibility === "visible" ? text.textContent : "";
    }),
  );

test("each gate says what it computes, and from near one sees its robot", async () => {
  for (const width of [1366, 1920]) {
    const page = await open("latch", { viewport: { width, height: 900 } });
    const all = [
      "nand(d, e)",
      "not(d)",
      "q = nand(nand(d, e), nq)",
      "nand(not(d), e)",
      "nq = nand(nand(not(d), e), q)",
    ];
    assert.deepEqual((await gates(page)).sort(), all.sort());
    await page.leave();
  }
  const page = await open("counter", { viewport: { width: 1366, height: 768 } });
  const whole = /^(xor|and|not)\((…|count\[\d\](, .*)?)\)$/;
  assert.ok(
    (await gates(page)).every(text => whole.test(text)),
    (await gates(page)).join(),
  );
  const bodies = page.locator('.schematic [data-id^="body-"]');
  for (let i = 0; i < 7; i++) {
    await page.locator(".schematic").press("+");
  }
  assert.equal(await bodies.first().isVisible(), true);
  for (let i = 0; i < 10; i++) {
    await page.locator(".schematic").press("-");
  }
  assert.equal(await bodies.first().isVisible(), false);
  await page.leave();
});

test("who comes near a part is in it, and who goes far sees what is around it", async () => {
  const page = await open("counter");
  assert.deepEqual(await crumbs(page), ["counter"]);
  await page.locator('.schematic [data-id="part-1"]').focus();
  while ((await crumbs(page)).length === 1) {
    await page.keyboard.press("+");
  }
  assert.deepEqual(await crumbs(page), ["counter", "count"]);
  await page.locator(".schematic").press("0");
  await page.locator(".schematic").press("-");
  assert.deepEqual(await crumbs(page), ["counter"]);
  await page.leave();
});

test("two fingers pinch it", { skip: onlyChromium("fingers") }, async () => {
  const page = await open("latch", { hasTouch: true });
  const box = await page.locator(".schematic").boundingBox();
  const scale = () => page.evaluate(() => document.querySelector(".schematic svg[aria-label]").getScreenCTM().a);
  const before = await scale();
  const touch = await page.context().newCDPSession(page);
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  const fingers = apart => [-1, 1].map((side, id) => ({ x: x + side * apart, y, id }));
  await touch.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: fingers(20) });
  for (const apart of [30, 40, 60]) {
    await touch.send("Input.dispatchTouchEvent", { type: "touchMove", touchPoints: fingers(apart) });
  }
  await touch.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
  const after = await scale();
  assert.ok(after > 2 * before, `${before} before, ${after} after`);
  await page.leave();
});

test("it is a group of buttons, not a picture", async () => {
  const page = await open("counter");
  const heard = await page.locator(".schematic").ariaSnapshot();
  assert.match(heard, /group "Schematic of the circuit"/);
  assert.match(heard, /button "open count: register, 24 robots"/);
  assert.match(heard, /button "[^"]*xor\(/);
  assert.doesNotMatch(heard, /\bimg\b/);
  const robot = page.locator('.schematic [data-id="cell-0"]');
  assert.equal(await robot.getAttribute("aria-pressed"), "false");
  await robot.press("Enter");
  assert.equal(await robot.getAttribute("aria-pressed"), "true");
  await page.leave();
});
