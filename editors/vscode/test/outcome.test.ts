// The answers of the server's commands, as the panel shows them.

import assert from "node:assert/strict";
import { test } from "node:test";

import { shownOf } from "../src/core/outcome";

const LATCH = { uri: "file:///a%20b/latch.nb" };

test("a page, a picture and a text are shown under the name of their subject", () => {
  const answer = { passed: true, text: "pass: 1 of 1 passed", page: "file:///t/report.html", path: "/t/report.html" };
  assert.deepEqual(shownOf("nbc.run", { ...LATCH, test: 0 }, answer), {
    kind: "report",
    title: "latch.nb",
    file: "/t/report.html",
  });
  const picture = { passed: null, text: "schematic", path: "/t/schematic.svg" };
  assert.deepEqual(shownOf("nbc.schematic", { ...LATCH, circuit: "d_latch", swarm: null }, picture), {
    kind: "drawing",
    title: "d_latch",
    file: "/t/schematic.svg",
  });
  assert.deepEqual(shownOf("nbc.timing", { ...LATCH, circuit: "f", swarm: "walkers" }, { text: "hold 4" }), {
    kind: "text",
    title: "walkers",
    text: "hold 4",
  });
  assert.deepEqual(shownOf("nbc.prove", { ...LATCH, claim: 0 }, { passed: true, text: "d_latch" }), {
    kind: "text",
    title: "latch.nb",
    text: "d_latch",
  });
});

test("other answers show nothing", () => {
  for (const answer of [null, undefined, "x", {}, { path: 3 }]) {
    assert.equal(shownOf("nbc.run", LATCH, answer), undefined);
  }
  assert.equal(shownOf("nbc.run", undefined, { text: "done" }), undefined);
});
