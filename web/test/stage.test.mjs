// A pane that fills the page, the names of the source, numbers as one wants them, the state of a machine, and what an
// environment writes.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";

import { closeBrowser, typeNumber, visit } from "./browser.mjs";
import { folderWith, play } from "./program.mjs";

const COMPUTER = readFileSync(new URL("../../circuits/computer.nb", import.meta.url), "utf8");
const LIGHTS = `enum light { green, yellow, red }

circuit lights(now: light, level[4], clk) -> (next: light, sum[4]) {
    next = match now { green: yellow, yellow: red, else: green }
    total = register(total + level, clk)
    sum = total xor 4'd1
}
`;
const TELLER = `file program = "hello.csv"

circuit teller(char[8], clk) -> (at[3], done) {
    done = char == 0
    at   = register(at + 1, clk, enable: not done)
}

environment desk(at[3]) -> (char[8], screen: text) {
    net words[8][8] init program
    char   = words[at]
    screen = {char != 0, char}
}

test teller "says hello" with desk {
    clk | done
    ^   | 0
    ^   | -    until done, at most 10 rows
}
`;

let place, program;

before(async () => {
  const files = { "computer.nb": COMPUTER, "lights.nb": LIGHTS, "teller.nb": TELLER, "hello.csv": "72, 105, 33, 0\n" };
  place = folderWith(files);
  program = await play(place.folder, "computer.nb");
});

after(async () => {
  await closeBrowser();
  await program?.stop();
  place?.remove();
});

async function open(name, options) {
  const page = await visit(`${program.address}#${name}.nb`, options);
  await page.locator(".schematic svg[aria-label]").waitFor();
  return page;
}

const seen = (page, selector) => page.locator(selector).first().isVisible();
const box = (page, selector) => page.locator(selector).first().boundingBox();

for (const [width, height] of [
  [1440, 900],
  [360, 740],
]) {
  test(`any pane fills a page of ${width} pixels, and Escape goes back`, async () => {
    const page = await open("lights", { viewport: { width, height } });
    await page.locator("[data-do=diagram-paths]").click();
    await page.evaluate(() => scrollTo(0, 0));
    for (const pane of ["stage", "schematic", "waveform", "spacetime"]) {
      const before = await box(page, `.${pane}`);
      await page.locator(`[data-fill="${pane}"]`).click();
      const filled = await box(page, `.${pane}`);
      assert.ok(filled.width > width - 40, `${pane} is ${filled.width} px wide`);
      assert.ok(filled.height > 0.45 * height && filled.y + filled.height <= height, JSON.stringify(filled));
      assert.equal(await seen(page, ".edit"), false);
      assert.equal(await seen(page, ".inputs"), true, "the inputs stay");
      const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      assert.equal(wide, 0);
      await page.keyboard.press("Escape");
      assert.deepEqual(await box(page, `.${pane}`), before);
    }
    await page.locator(".schematic").focus();
    await page.keyboard.press("f");
    assert.equal(await seen(page, ".stage"), false);
    assert.equal(await seen(page, ".schematic"), true);
    await page.keyboard.press("f");
    assert.equal(await seen(page, ".stage"), true);
    await page.leave();
  });
}

test("parts and nets have the names of the source, and no others", async () => {
  const page = await open("computer");
  const parts = page.locator('.schematic [data-id^="part-"]');
  const titles = () => parts.evaluateAll(all => all.map(part => part.querySelector("title").textContent));
  assert.deepEqual(await titles(), ["machine: pc, 126 robots"]);
  const texts = [];
  for (let sheet = 0; sheet < 2; sheet++) {
    texts.push(...(await page.locator(".schematic svg :is(text, title)").allTextContents()), ...(await titles()));
    await parts.first().press("Enter");
  }
  assert.ok(texts.length > 40);
  assert.deepEqual(
    texts.filter(text => /\bn\d+\b|\bpart \d/.test(text)),
    [],
  );
  await page.leave();
});

test("numbers are typed and shown as one wants them", async () => {
  const page = await open("lights");
  const level = page.locator('input[data-input="level"]');
  const bits = async () =>
    (await page.locator('button[data-input^="level["]').evaluateAll(all => all.map(one => one.ariaChecked))).map(
      checked => Number(checked === "true"),
    );
  for (const [typed, expected] of [
    ["0xa", [1, 0, 1, 0]],
    ["-3", [1, 1, 0, 1]],
  ]) {
    await typeNumber(level, typed);
    await level.press("Enter");
    assert.deepEqual(await bits(), expected);
  }
  const format = page.locator(".format");
  await format.selectOption("hex");
  assert.equal(await level.inputValue(), "0xd");
  await format.selectOption("signed");
  assert.equal(await level.inputValue(), "-3");
  await format.selectOption("names");
  await page.locator('select[data-input="now"]').selectOption("yellow");
  await page.waitForFunction(() => document.querySelector('[data-output="next"]').textContent === "red");
  await page.leave();
});

test("a machine shows its registers by name, and the row of its program that holds", async () => {
  const page = await open("computer");
  await page.locator(".circuit").selectOption({ label: "product" });
  await page.locator('[data-do="state"]').click();
  const names = page.locator(".state .registers th");
  await page.waitForFunction(() => document.querySelector(".state .listing")?.textContent.includes("load"));
  assert.deepEqual(await names.allTextContents(), ["a", "b", "pc"]);
  const now = page.locator(".state .listing [aria-current]");
  await now.waitFor();
  assert.equal(await now.textContent(), "000load(3'd3)");
  await page.leave();
});

test("what an environment writes is shown below the rows", async () => {
  const page = await open("teller");
  await page.locator("#tab-tests").click();
  await page.locator('[data-do="logic"]').first().click();
  await page.locator(".test pre").waitFor();
  assert.equal(await page.locator(".test pre").textContent(), "Hi!");
  await page.leave();
});
