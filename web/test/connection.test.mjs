// A page that loses its program says so and comes back; two pages do not disturb each other.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { closeBrowser, cyclesLater, lamp, setInput, typeProgram, visit, walking } from "./browser.mjs";
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

test("two pages have a swarm each", async () => {
  const other = await visit(program.url);
  await walking(other);
  await setInput(page, "d", 1);
  await setInput(page, "e", 1);
  await setInput(other, "e", 1);
  await Promise.all([cyclesLater(page, 8), cyclesLater(other, 8)]);
  assert.deepEqual([await lamp(page, "q"), await lamp(other, "q")], [1, 0]);
  await other.leave();
});

test("a lost program is noticed, and the page goes on where it was", async () => {
  await typeProgram(page, LATCH.replace("d_latch(d, e)", "my_latch(d, e)").replace("test d_latch", "test my_latch"));
  await page.waitForFunction(() => document.querySelector(".schematic").textContent.includes("my_latch"));
  await walking(page);
  await program.stop();
  await page.getByText("Connection lost").waitFor();
  program = await play(place.folder, "latch.nb", { port: program.port, token: program.token });
  await page.locator(".banner").waitFor({ state: "hidden" });
  await walking(page);
  await cyclesLater(page, 8);
  assert.equal(await page.locator('button[data-input="d"]').getAttribute("aria-checked"), "true");
  assert.equal(await lamp(page, "q"), 1);
  await typeProgram(page, "circuit broken(a) -> (q) {\n    q = b\n}\n");
  await page.locator(".cm-lintRange-error").waitFor();
});
