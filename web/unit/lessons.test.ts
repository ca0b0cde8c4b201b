import assert from "node:assert/strict";
import { test } from "node:test";

import type { NicheEntry } from "../src/protocol";
import { hasShown, keeps, shows, type Values } from "../src/learn/checks";
import { LESSONS, outputNames } from "../src/learn/lessons";
import { Progress } from "../src/learn/progress";
import type { Situation } from "../src/learn/situation";

/** A page that has run these cycles, each with the numbers at its ports. */
function situation(cycles: Values[], given: Partial<Situation> = {}): Situation {
  return {
    path: "",
    text: "",
    errors: 0,
    circuits: 1,
    tests: 0,
    passed: 0,
    now: cycles.length,
    hold: 2,
    port: (name, cycle) => cycles[cycle - 1]?.[name] ?? null,
    design: { body: [], probe: null },
    search: { running: false, niches: [], chosen: null },
    ...given,
  };
}

test("a value must stay for as long as a change needs to settle", () => {
  const q = (...values: number[]): Situation => situation(values.map(value => ({ q: value })));
  assert.equal(shows({ q: 1 })(q(0, 1)), true);
  assert.equal(keeps({ q: 1 })(q(0, 1)), false);
  assert.equal(keeps({ q: 1 })(q(0, 1, 1, 1)), true);
  assert.equal(keeps({ q: 1 })(q(1, 1, 0, 1)), false);
  assert.equal(keeps({ r: 1 })(q(1, 1, 1, 1)), false);
});

test("patterns may have been shown at any time", () => {
  const check = hasShown([{ a: 0 }, { a: 1 }]);
  assert.equal(check(situation([{ a: 0 }, { a: 0 }])), false);
  assert.equal(check(situation([{ a: 1 }, { a: 0 }])), true);
});

test("the lesson on the latch is done by using it as a memory", () => {
  const lesson = LESSONS.find(({ name }) => name === "latch");
  assert.ok(lesson !== undefined);
  const progress = new Progress({});
  const held = (d: number, e: number, q: number): Situation =>
    situation(Array.from({ length: 3 }, () => ({ d, e, q })));
  assert.equal(progress.advance(lesson, held(1, 0, 1)), false);
  assert.equal(progress.advance(lesson, held(1, 1, 1)), true);
  assert.equal(progress.advance(lesson, held(0, 0, 1)), false);
  assert.equal(progress.advance(lesson, held(1, 0, 1)), true);
  assert.equal(progress.advance(lesson, held(0, 0, 0)), false);
  assert.equal(progress.advance(lesson, held(0, 0, 1)), true);
  assert.equal(progress.isFinished(lesson), true);
  progress.restart(lesson);
  assert.equal(progress.done(lesson), 0);
});

test("there are eight lessons, each with something to do", () => {
  assert.equal(LESSONS.length, 8);
  assert.equal(new Set(LESSONS.map(lesson => lesson.name)).size, 8);
  LESSONS.forEach(lesson => assert.ok(lesson.steps.length > 0));
});

test("the lesson on evolution follows the search at once, and not one of before", () => {
  const lesson = LESSONS.find(({ name }) => name === "evolution");
  assert.ok(lesson !== undefined);
  const body = ["343"];
  const niche: NicheEntry = { place: [0], fitness: [1, 1], body, letters: "RRRL", function: "nand" };
  const [begin, wait, click] = lesson.steps.map(step => step.check);
  const old = { running: false, niches: [niche, niche, niche, niche, niche], chosen: null };
  assert.equal(begin?.(situation([], { search: old })), false);
  assert.equal(begin?.(situation([], { search: { running: true, niches: [], chosen: null } })), true);
  assert.equal(wait?.(situation([], { search: old })), true);
  const chosen = { ...old, chosen: niche };
  assert.equal(click?.(situation([], { search: old, design: { body, probe: null } })), false);
  assert.equal(click?.(situation([], { search: chosen, design: { body, probe: null } })), true);
});

test("outputs are found in a text", () => {
  assert.deepEqual(outputNames("circuit x(a, b) -> (q, sum[3]) {}\ncircuit y() -> (z) {}"), ["q", "sum", "z"]);
});
