// The designer: from an empty box to a NAND, with the mouse and with the keyboard.

import assert from "node:assert/strict";
import { test } from "node:test";

import { filesOf, typeNumber } from "./browser.mjs";
import { opened } from "./opened.mjs";
import { LATCH } from "./program.mjs";

const NAND = ["37555", "77765", "02563", "00263", "33333"];

const here = opened({ "latch.nb": LATCH }, "latch.nb", async page => {
  await page.locator("#tab-robots").click();
  await page.locator(".palette [data-code]").first().waitFor();
});

const body = () =>
  here.page.evaluate(() =>
    [...document.querySelectorAll(".grid .line")].map(row =>
      [...row.children].map(voxel => voxel.dataset.code).join(""),
    ),
  );

const letters = text => here.page.locator(`.probe[data-letters="${text}"]:not([data-waiting])`).waitFor();

test("the designer begins with a NAND that walks", async () => {
  await letters("RRRL");
  assert.equal(await here.page.locator(".probe h3").textContent(), "a NAND b");
});

test("an empty box is said to be empty", async () => {
  await here.page.locator("[data-do=clear]").click();
  await here.page.getByText("the body is empty").waitFor();
  assert.deepEqual(await body(), ["00000", "00000", "00000", "00000", "00000"]);
});

test("painting the voxels of a NAND makes a NAND", async () => {
  for (const [y, row] of NAND.entries()) {
    for (const [x, code] of [...row].entries()) {
      if (code !== "0") {
        await here.page.locator(`.palette [data-code="${code}"]`).click();
        await here.page.locator(`.voxel[data-x="${x}"][data-y="${y}"]`).click();
      }
    }
  }
  assert.deepEqual(await body(), NAND);
  await letters("RRRL");
  assert.equal(await here.page.locator(".probe h3").textContent(), "a NAND b");
  // Its errors are counted over many switches, which takes a while.
  await here.page.locator(".probe .facts").getByText("1 cycle").waitFor({ timeout: 240_000 });
});

test("undo, mirror, and swapping inputs", async () => {
  await here.page.locator("[data-do=mirror]").click();
  assert.deepEqual(
    await body(),
    NAND.map(row => [...row].reverse().join("")),
  );
  await here.page.locator("[data-do=undo]").click();
  assert.deepEqual(await body(), NAND);
  await here.page.locator("[data-do=swap]").click();
  assert.notDeepEqual(await body(), NAND);
  await letters("RRRL");
  await here.page.locator("[data-do=undo]").click();
  await here.page.locator("[data-do=redo]").click();
  await here.page.locator("[data-do=undo]").click();
  assert.deepEqual(await body(), NAND);
});

test("the keyboard paints, too", async () => {
  await here.page.locator("[data-do=clear]").click();
  await here.page.locator('.voxel[data-x="0"][data-y="0"]').focus();
  for (const [y, row] of NAND.entries()) {
    for (const code of row) {
      await here.page.keyboard.press(code);
      await here.page.keyboard.press("ArrowRight");
    }
    for (let back = 0; back < row.length; back++) {
      await here.page.keyboard.press("ArrowLeft");
    }
    if (y < NAND.length - 1) {
      await here.page.keyboard.press("ArrowDown");
    }
  }
  assert.deepEqual(await body(), NAND);
});

test("a body that is no longer empty is not said to be", async () => {
  await here.page.locator("[data-do=clear]").click();
  const title = here.page.locator(".probe h3");
  await title.getByText("the body is empty").waitFor();
  // Before an answer can come.
  const said = await here.page.evaluate(() => {
    document.querySelector("[data-do=random]").click();
    return document.querySelector(".probe h3").textContent;
  });
  assert.doesNotMatch(said, /empty/);
  await here.page.locator("[data-do=undo]").click();
  await here.page.locator("[data-do=undo]").click();
  assert.deepEqual(await body(), NAND);
});

test("a stroke paints many voxels and is undone at once", async () => {
  await here.page.locator("[data-do=clear]").click();
  await here.page.locator('.palette [data-code="4"]').click();
  const box = async x => here.page.locator(`.voxel[data-x="${x}"][data-y="4"]`).boundingBox();
  const [from, to] = [await box(0), await box(4)];
  await here.page.mouse.move(from.x + 9, from.y + 9);
  await here.page.mouse.down();
  await here.page.mouse.move(to.x + 9, to.y + 9, { steps: 12 });
  await here.page.mouse.up();
  assert.deepEqual((await body())[4], "44444");
  await here.page.locator("[data-do=undo]").click();
  assert.deepEqual((await body())[4], "00000");
  await here.page.locator("[data-do=undo]").click();
  assert.deepEqual(await body(), NAND);
});

test("it is kept as a robot file, and the program uses it", async () => {
  await here.page.locator(".keeping input").fill("mine");
  await here.page.locator("[data-do=keep]").click();
  await here.page.getByText("wrote robots/mine.yaml").waitFor();
  await filesOf(here).has("robots/mine.yaml", /name: mine/);
  // Another one of that name is not replaced without a question, and what takes long can be stopped.
  await here.page.locator("[data-do=keep]").click();
  await here.page.getByText("robots/mine.yaml` is there already").waitFor();
  await here.page.locator("[data-do=replace]").click();
  await here.page.getByText("measuring it over").waitFor();
  await here.page.locator("[data-do=stop-keep]").click();
  await here.page.getByText("nothing was kept").waitFor();
  await here.page.waitForFunction(() =>
    /library \w+ \{/.test(document.querySelector(".editor").shadowRoot.textContent),
  );
  await here.page.locator(".keeping input").fill("other");
  await here.page.locator("[data-do=keep]").click();
  await here.page.getByText("wrote robots/other.yaml").waitFor();
  await here.page.getByRole("button", { name: "Build d_latch from your robots alone" }).click();
  await here.page.locator('#tab-swarm[aria-selected="true"]').waitFor();
  await here.page
    .locator(".schematic")
    .getByRole("button", { name: /robot mine$/ })
    .first()
    .waitFor();
  await here.page.waitForFunction(() => /^\d+ robots/.test(document.querySelector(".swarm .status").textContent));
  assert.equal(
    await here.page.locator(".circuit").evaluate(select => select.selectedOptions[0].textContent),
    "d_latch as d_latch_own",
  );
  await here.page.locator("#tab-robots").click();
});

test("a robot of three senses walks in eight lanes", async () => {
  await here.page.locator('[data-robot="and3_5x5"] [data-do=design]').click();
  await letters("LLLLLLLR");
  assert.equal(await here.page.locator(".probe .lane").count(), 8);
  assert.equal(await here.page.locator(".probe h3").textContent(), "a AND b AND c");
  assert.equal(await here.page.locator(".probe .truth td").count(), 8);
  const wide = await here.page.evaluate(() => {
    const design = document.querySelector(".design");
    return design.scrollWidth - design.clientWidth;
  });
  assert.ok(wide <= 0, `the designer is ${wide} too wide`);
});

test("a robot of the library walks on its card and opens in the designer", async () => {
  const card = here.page.locator('[data-robot="xor_5x5"]');
  // The cards are drawn anew when the list is read again, which this waits for.
  await card.hover();
  await card.getByText("walks").waitFor();
  await card.locator("[data-do=design]").click();
  await letters("LRRL");
});

test("a search from there opens niches, and their robots can be taken", async () => {
  await typeNumber(here.page.locator(".evolution input"), 30);
  await here.page.locator("[data-do=evolve]").click();
  await here.page.locator(".niche:not(:disabled)").nth(2).waitFor();
  // Others open meanwhile, so it is found again by its place.
  const place = await here.page.locator(".niche:not(:disabled)").first().getAttribute("data-niche");
  const niche = here.page.locator(`.niche[data-niche="${place}"]`);
  const label = await niche.getAttribute("aria-label");
  await niche.click();
  await letters(/, ([RL?]{4}),/.exec(label)?.[1] ?? label);
  await here.page.locator("[data-do=evolve]").click();
  await here.page.getByRole("button", { name: "Evolve from here" }).waitFor();
});

test("robots are found by name or gate", async () => {
  const shown = () => here.page.locator(".robot.card:visible").count();
  const all = await shown();
  const field = here.page.getByLabel("Find robots by name or gate");
  await field.fill("a NAND b");
  assert.ok((await shown()) > 0 && (await shown()) < all);
  await field.fill("no such robot");
  await here.page.getByText("no robot matches").waitFor();
  assert.equal(await shown(), 0);
  await field.fill("");
  assert.equal(await shown(), all);
});
