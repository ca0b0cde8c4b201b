// The designer: from an empty box to a NAND, with the mouse and with the keyboard.

import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import path from "node:path";
import { after, before, test } from "node:test";

import { closeBrowser, visit, walking } from "./browser.mjs";
import { LATCH, folderWith, play } from "./program.mjs";

const NAND = ["37555", "77765", "02563", "00263", "33333"];

let place, program, page;

before(async () => {
  place = folderWith({ "latch.nb": LATCH });
  program = await play(place.folder, "latch.nb");
  page = await visit(program.url);
  await walking(page);
  await page.locator("#tab-robots").click();
  await page.locator(".palette [data-code]").first().waitFor();
});

after(async () => {
  await page?.leave();
  await closeBrowser();
  await program?.stop();
  place?.remove();
});

const body = () =>
  page.evaluate(() =>
    [...document.querySelectorAll(".grid .line")].map(row =>
      [...row.children].map(voxel => voxel.dataset.code).join(""),
    ),
  );

const letters = text => page.locator(`.probe[data-letters="${text}"]:not([data-waiting])`).waitFor();

test("an empty box is said to be empty", async () => {
  await page.getByText("the body is empty").waitFor();
  assert.deepEqual(await body(), ["00000", "00000", "00000", "00000", "00000"]);
});

test("painting the voxels of a NAND makes a NAND", async () => {
  for (const [y, row] of NAND.entries()) {
    for (const [x, code] of [...row].entries()) {
      if (code !== "0") {
        await page.locator(`.palette [data-code="${code}"]`).click();
        await page.locator(`.voxel[data-x="${x}"][data-y="${y}"]`).click();
      }
    }
  }
  assert.deepEqual(await body(), NAND);
  await letters("RRRL");
  assert.equal(await page.locator(".probe h3").textContent(), "a NAND b");
  // Its errors are counted over many switches, which takes a while.
  await page.locator(".probe .facts").getByText("1 cycle").waitFor({ timeout: 240_000 });
});

test("undo, mirror, and swapping inputs", async () => {
  await page.locator("[data-do=mirror]").click();
  assert.deepEqual(
    await body(),
    NAND.map(row => [...row].reverse().join("")),
  );
  await page.locator("[data-do=undo]").click();
  assert.deepEqual(await body(), NAND);
  await page.locator("[data-do=swap]").click();
  assert.notDeepEqual(await body(), NAND);
  await letters("RRRL");
  await page.locator("[data-do=undo]").click();
  await page.locator("[data-do=redo]").click();
  await page.locator("[data-do=undo]").click();
  assert.deepEqual(await body(), NAND);
});

test("the keyboard paints, too", async () => {
  await page.locator("[data-do=clear]").click();
  await page.locator('.voxel[data-x="0"][data-y="0"]').focus();
  for (const [y, row] of NAND.entries()) {
    for (const code of row) {
      await page.keyboard.press(code);
      await page.keyboard.press("ArrowRight");
    }
    for (let back = 0; back < row.length; back++) {
      await page.keyboard.press("ArrowLeft");
    }
    if (y < NAND.length - 1) {
      await page.keyboard.press("ArrowDown");
    }
  }
  assert.deepEqual(await body(), NAND);
});

test("a stroke paints many voxels and is undone at once", async () => {
  await page.locator("[data-do=clear]").click();
  await page.locator('.palette [data-code="4"]').click();
  const box = async x => page.locator(`.voxel[data-x="${x}"][data-y="4"]`).boundingBox();
  const [from, to] = [await box(0), await box(4)];
  await page.mouse.move(from.x + 9, from.y + 9);
  await page.mouse.down();
  await page.mouse.move(to.x + 9, to.y + 9, { steps: 12 });
  await page.mouse.up();
  assert.deepEqual((await body())[4], "44444");
  await page.locator("[data-do=undo]").click();
  assert.deepEqual((await body())[4], "00000");
  await page.locator("[data-do=undo]").click();
  assert.deepEqual(await body(), NAND);
});

test("it is kept as a robot file, and the program uses it", async () => {
  await page.locator(".keeping input").fill("mine");
  await page.locator("[data-do=keep]").click();
  await page.getByText("wrote robots/mine.yaml").waitFor();
  assert.ok(existsSync(path.join(place.folder, "robots", "mine.yaml")));
  await page.waitForFunction(() => /library \w+ \{/.test(document.querySelector(".editor").shadowRoot.textContent));
  await page.locator("[data-do=build]").click();
  await page.locator("#tab-swarm").click();
  await page.locator(".circuit").selectOption({ label: "d_latch as d_latch_own" });
  await page.locator('.schematic [data-id="cell-0"] text', { hasText: "mine" }).waitFor();
  await page.waitForFunction(() => /^\d+ robots/.test(document.querySelector(".swarm .status").textContent));
  assert.equal(
    await page.locator(".circuit").evaluate(select => select.selectedOptions[0].textContent),
    "d_latch as d_latch_own",
  );
  await page.locator("#tab-robots").click();
});

test("a robot of the library walks on its card and opens in the designer", async () => {
  const card = page.locator('[data-robot="xor_5x5"]');
  await card.scrollIntoViewIfNeeded();
  await card.getByText("walks").waitFor();
  await card.locator("[data-do=design]").click();
  await letters("LRRL");
});

test("a search from there opens niches, and their robots can be taken", async () => {
  await page.locator(".evolution input").fill("30");
  await page.locator("[data-do=evolve]").click();
  await page.locator(".niche:not(:disabled)").nth(2).waitFor();
  // Others open meanwhile, so it is found again by its place.
  const place = await page.locator(".niche:not(:disabled)").first().getAttribute("data-niche");
  const niche = page.locator(`.niche[data-niche="${place}"]`);
  const label = await niche.getAttribute("aria-label");
  await niche.click();
  await letters(/, ([RL?]{4}),/.exec(label)?.[1] ?? label);
  await page.locator("[data-do=evolve]").click();
  await page.getByRole("button", { name: "Evolve from here" }).waitFor();
});
