// The tests of a program: a failing row leads to its line and to its moment in the run.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { closeBrowser, cycle, lamp, visit, walking } from "./browser.mjs";
import { LATCH, folderWith, play } from "./program.mjs";

// The third row expects the latch to forget.
const FAILING = LATCH.replace("    1 0 | 1\n", "    1 0 | 0\n");
const FAILING_LINE = 1 + FAILING.split("\n").indexOf("    1 0 | 0");

let place, program, page;

before(async () => {
  place = folderWith({ "latch.nb": FAILING });
  program = await play(place.folder, "latch.nb");
  page = await visit(program.url);
  await walking(page);
  await page.locator("#tab-tests").click();
});

after(async () => {
  await page?.leave();
  await closeBrowser();
  await program?.stop();
  place?.remove();
});

for (const level of ["logic", "physics"]) {
  test(`a failing row is found: ${level}`, async () => {
    await page.locator(`.test [data-do=${level}]`).click();
    await page.locator('.test[data-state=done][data-passed="false"]').waitFor();
    await page.getByText(level === "logic" ? "✗ fails as logic" : "✗ fails in physics").waitFor();
    assert.equal(await page.locator('.rows tr[data-passed="false"]').count(), 1);
    assert.equal(await page.locator('.rows tr[data-passed="true"]').count(), 4);
  });
}

test("it leads to its line", async () => {
  await page.locator('.rows tr[data-passed="false"] [data-do=line]').click();
  const active = page.locator(".cm-activeLineGutter.cm-gutterElement").last();
  await active.waitFor();
  const line = await page.evaluate(() => {
    const { shadowRoot } = document.querySelector(".editor");
    return [...shadowRoot.querySelectorAll(".cm-lineNumbers .cm-activeLineGutter")]
      .map(gutter => gutter.textContent)
      .join();
  });
  assert.equal(line, String(FAILING_LINE));
});

test("it leads to its moment in the run, which can be rewound", async () => {
  await page.locator('.rows tr[data-passed="false"] [data-do=moment]').click();
  await page.locator("#tab-swarm[aria-selected=true]").waitFor();
  await page.locator('[data-lamp="q"][data-value="1"]').waitFor();
  assert.equal(await page.locator('button[data-input="d"]').getAttribute("aria-checked"), "true");
  assert.equal(await page.locator('button[data-input="e"]').getAttribute("aria-checked"), "false");
  assert.equal(await lamp(page, "nq"), 0);
  const end = await cycle(page);
  await page.locator(".rewind").fill("2");
  await page.waitForFunction(last => document.querySelector(".cycle").textContent === `cycle 2 of ${last}`, end);
});
