// The tests of a program: a failing row leads to its line and to its moment in the run.

import assert from "node:assert/strict";
import { test } from "node:test";

import { cycle, lampsShow, typeProgram } from "./browser.mjs";
import { opened } from "./opened.mjs";
import { LATCH } from "./program.mjs";

// The third row expects the latch to forget.
const FAILING = LATCH.replace("    1 0 | 1\n", "    1 0 | 0\n");
const FAILING_LINE = 1 + FAILING.split("\n").indexOf("    1 0 | 0");

const ROWS = "a,b,q\n0,0,0\n0,1,1\n1,1,1\n";

const here = opened({ "latch.nb": FAILING, "rows.csv": ROWS }, "latch.nb", async page => {
  await page.locator("#tab-tests").click();
});

for (const level of ["logic", "physics"]) {
  test(`a failing row is found: ${level}`, async () => {
    await here.page.locator(`.test [data-do=${level}]`).click();
    await here.page.locator('.test[data-state=done][data-passed="false"]').waitFor();
    await here.page.getByText(level === "logic" ? "✗ fails as logic" : "✗ fails in physics").waitFor();
    assert.equal(await here.page.locator('.rows tr[data-passed="false"]').count(), 1);
    assert.equal(await here.page.locator('.rows tr[data-passed="true"]').count(), 4);
  });
}

/** Follows the first failing row, to a line of the program. */
async function follow() {
  await here.page.locator('.rows tr[data-passed="false"] [data-do=line]').click();
  const active = here.page.locator(".cm-activeLineGutter.cm-gutterElement").last();
  await active.waitFor();
  const line = await here.page.evaluate(() => {
    const { shadowRoot } = document.querySelector(".editor");
    return [...shadowRoot.querySelectorAll(".cm-lineNumbers .cm-activeLineGutter")]
      .map(gutter => gutter.textContent)
      .join();
  });
  return Number(line);
}

test("it leads to its line", async () => {
  assert.equal(await follow(), FAILING_LINE);
});

test("it leads to its moment in the run, which can be rewound", async () => {
  await here.page.locator('.rows tr[data-passed="false"] [data-do=moment]').click();
  await here.page.locator("#tab-swarm[aria-selected=true]").waitFor();
  await lampsShow(here.page, { q: 1, nq: 0 });
  assert.equal(await here.page.locator('button[data-input="d"]').getAttribute("aria-checked"), "true");
  assert.equal(await here.page.locator('button[data-input="e"]').getAttribute("aria-checked"), "false");
  const end = await cycle(here.page);
  await here.page.locator(".rewind").fill("2");
  await here.page.waitForFunction(last => document.querySelector(".cycle").textContent === `cycle 2 of ${last}`, end);
});

test("a test that is started right after an edit runs after its check", async () => {
  await here.page.locator("#tab-tests").click();
  await typeProgram(here.page, LATCH);
  await here.page.locator(".test [data-do=logic]").click();
  await here.page.getByText("✓ passes as logic").waitFor();
  // The check that the edit would have caused later takes nothing away.
  await here.page.waitForTimeout(800);
  assert.ok(await here.page.getByText("✓ passes as logic").isVisible());
});

test("what refutes a property is watched, and becomes a test", async () => {
  const claimed = LATCH.replace(/\nprove[^]*$/, "\n").concat(
    'prove d_latch "new" {\n    never q and nq\n    never q\n}\n',
  );
  await typeProgram(here.page, claimed);
  // The card before has another title.
  const claim = here.page.locator("[data-claim]", { hasText: "new" });
  await claim.locator("[data-do=prove]").click();
  await here.page.locator("[data-verdict=proved]").waitFor();
  const refuted = here.page.locator("[data-verdict=refuted]");
  await refuted.locator("[data-do=append]").click();
  await here.page.locator(".test h3", { hasText: "d_latch" }).nth(2).waitFor();
  await claim.locator("[data-do=prove]").click();
  await refuted.locator("[data-do=watch]").click();
  await here.page.locator("#tab-swarm[aria-selected=true]").waitFor();
  await lampsShow(here.page, { q: 1, nq: 0 });
});

test("a test from a file says how many rows pass, and its rows lead to it", async () => {
  const gate = "circuit gate(a, b) -> (q) {\n    q = a and b\n}\n";
  await typeProgram(here.page, `${gate}\ntest gate "of a file" from "rows.csv" at least 60%\n`);
  await here.page.locator("#tab-tests").click();
  await here.page.locator(".test", { hasText: "of a file" }).locator("[data-do=logic]").click();
  await here.page.getByText("✓ passes as logic: 2 of 3, at least 60 %").waitFor();
  await here.page.getByText("line 3 of rows.csv").waitFor();
  assert.equal(await follow(), 5);
});
