// A page that loses its program says so and comes back; two pages do not disturb each other.

import assert from "node:assert/strict";
import { test } from "node:test";

import { cyclesLater, lampsShow, setInput, typeProgram, visit, walking } from "./browser.mjs";
import { opened } from "./opened.mjs";
import { LATCH, play } from "./program.mjs";

const here = opened({ "latch.nb": LATCH }, "latch.nb");

test("two pages have a swarm each", async () => {
  const other = await visit(here.program.url);
  await walking(other);
  await setInput(here.page, "d", 1);
  await setInput(here.page, "e", 1);
  await setInput(other, "e", 1);
  await Promise.all([cyclesLater(here.page, 8), cyclesLater(other, 8)]);
  await Promise.all([lampsShow(here.page, { q: 1 }), lampsShow(other, { q: 0 })]);
  await other.leave();
});

test("a lost program is noticed, and the page goes on where it was", async () => {
  await typeProgram(here.page, LATCH.replaceAll("d_latch", "my_latch"));
  await here.page.waitForFunction(() => document.querySelector(".crumbs").textContent.includes("my_latch"));
  await walking(here.page);
  await here.program.stop();
  await here.page.getByText("Connection lost").waitFor();
  here.program = await play(here.place.folder, "latch.nb", { port: here.program.port, token: here.program.token });
  await here.page.locator(".banner").waitFor({ state: "hidden" });
  await walking(here.page);
  await cyclesLater(here.page, 8);
  assert.equal(await here.page.locator('button[data-input="d"]').getAttribute("aria-checked"), "true");
  await lampsShow(here.page, { q: 1 });
  await typeProgram(here.page, "circuit broken(a) -> (q) {\n    q = b\n}\n");
  await here.page.locator(".cm-lintRange-error").waitFor();
});
