import assert from "node:assert/strict";
import { test } from "node:test";

import type { EliteData, LessonCheck, LessonEntry, WrittenProgram } from "../src/protocol";
import { holds } from "../src/learn/checks";
import { Progress } from "../src/learn/progress";
import { isLessonPath, lessonAddress } from "../src/learn/lessons";
import { missing } from "../src/learn/missing";
import { sizeOf, sizeText, starsOf } from "../src/learn/score";
import type { Situation } from "../src/learn/situation";

type Values = Record<string, number>;

/** A page that has run these cycles, each with the numbers at its ports. */
function situation(cycles: Values[], given: Partial<Situation> = {}): Situation {
  return {
    path: "",
    written: WRITTEN,
    isChecked: true,
    errors: 0,
    problem: null,
    circuits: 1,
    tests: 0,
    passed: 0,
    failed: 0,
    hidden: new Map(),
    claims: 0,
    proved: 0,
    refuted: 0,
    circuit: null,
    robots: [],
    gates: 0,
    outputs: [],
    threads: 0,
    now: cycles.length,
    hold: 2,
    port: (name, cycle) => cycles[cycle - 1]?.[name] ?? null,
    design: { body: [], probe: null },
    search: { running: false, niches: [], chosen: null },
    ...given,
  };
}

function lesson(checks: LessonCheck[], given: Partial<LessonEntry> = {}): LessonEntry {
  const steps = checks.map(check => ({ task: "", checks: [check], hints: [] }));
  const none = { chapter: null, program: null, written: WRITTEN, hints: [], best: null };
  return { name: "one", title: "", text: [], tab: "swarm", ...none, steps, ...given };
}

const WRITTEN: WrittenProgram = { text: "test f", words: ["q", "=", "nand"], kept: ["a b | q", "0 1 | 1"] };

function is(check: LessonCheck, given: Situation): boolean {
  return holds(check, given, lesson([check]));
}

test("a value must stay for as long as a change needs to settle", () => {
  const q = (...values: number[]): Situation => situation(values.map(value => ({ q: value })));
  const keeps: LessonCheck = { is: "keeps", values: { q: 1 } };
  assert.equal(is({ is: "shows", values: { q: 1 } }, q(0, 1)), true);
  assert.equal(is(keeps, q(0, 1)), false);
  assert.equal(is(keeps, q(0, 1, 1, 1)), true);
  assert.equal(is(keeps, q(1, 1, 0, 1)), false);
  assert.equal(is({ is: "keeps", values: { r: 1 } }, q(1, 1, 1, 1)), false);
});

test("patterns may have been shown at any time, and what is hidden is not there now", () => {
  const patterns = [{ a: 0 }, { a: 1 }];
  assert.equal(is({ is: "has-shown", patterns }, situation([{ a: 0 }, { a: 0 }])), false);
  assert.equal(is({ is: "has-shown", patterns }, situation([{ a: 1 }, { a: 0 }])), true);
  assert.equal(is({ is: "hides", patterns }, situation([{ a: 1 }])), false);
  assert.equal(is({ is: "hides", patterns }, situation([{ a: 1 }, { a: 2 }])), true);
  assert.equal(is({ is: "hides", patterns }, situation([])), false);
});

test("a lesson on the latch is done by using it as a memory", () => {
  const keeps = (d: number, e: number, q: number): LessonCheck => ({ is: "keeps", values: { d, e, q } });
  const latch = lesson([keeps(1, 1, 1), keeps(1, 0, 1), keeps(0, 0, 1)]);
  const progress = new Progress({}, {});
  const held = (d: number, e: number, q: number): Situation =>
    situation(Array.from({ length: 3 }, () => ({ d, e, q })));
  assert.equal(progress.advance(latch, 0, held(1, 0, 1)), false);
  assert.equal(progress.advance(latch, 0, held(1, 1, 1)), true);
  assert.equal(progress.advance(latch, 1, held(0, 0, 1)), false);
  assert.equal(progress.advance(latch, 1, held(1, 0, 1)), true);
  assert.equal(progress.advance(latch, 2, held(0, 0, 0)), false);
  assert.equal(progress.advance(latch, 2, held(0, 0, 1)), true);
  assert.equal(progress.isFinished(latch), true);
  progress.restart(latch);
  assert.equal(progress.done(latch), 0);
});

test("a step that is done out of turn counts, and the next one is the first that is open", () => {
  const shows = (q: number): LessonCheck => ({ is: "shows", values: { q } });
  const three = lesson([shows(1), shows(2), shows(3)]);
  const progress = new Progress({}, {});
  assert.equal(progress.advance(three, 1, situation([{ q: 2 }])), true);
  assert.deepEqual([progress.done(three), progress.isFinished(three)], [1, false]);
  assert.deepEqual([progress.next(three), progress.next(three, 1)], [0, 2]);
  assert.equal(progress.advance(three, 2, situation([{ q: 3 }])), true);
  assert.equal(progress.next(three, 2), 0);
  // Browsers remember how many of the first steps were done from before.
  assert.deepEqual([...new Progress({ one: 2 }, {}).steps(three)], [0, 1]);
});

test("an address names a lesson and its step, from 1", () => {
  assert.deepEqual(lessonAddress("lesson/full-adder/2"), { name: "full-adder", step: 1 });
  assert.deepEqual(lessonAddress("lesson/nand"), { name: "nand", step: 0 });
  for (const other of ["lesson_nand.nb", "lesson/a.nb", "lesson/", "lesson/nand/x", "lesson/nand/2/3"]) {
    assert.equal(lessonAddress(other), null, other);
  }
});

test("a step says why it does not count", () => {
  const needs = (check: LessonCheck, given: Situation): string => missing(lesson([check]), 0, given, true).join("; ");
  const now = situation([{ a: 1, q: 0 }]);
  assert.equal(needs({ is: "shows", values: { a: 1, q: 1 } }, now), "the swarm shows a = 1, q = 1 – now q = 0");
  assert.match(needs({ is: "keeps", values: { a: 1 } }, now), / – not for long enough yet$/);
  assert.match(needs({ is: "has-shown", patterns: [{ a: 0 }, { a: 1 }] }, now), / – not yet a = 0$/);
  assert.match(needs({ is: "without", words: ["not", "nand"] }, situation([])), / – `nand` is there$/);
  // The word is not taken for one of the sentence.
  const not = situation([], { written: { ...WRITTEN, words: ["not", "calls"] } });
  assert.equal(
    needs({ is: "without", words: ["not", "calls"] }, not),
    "the circuits are written without `not`, calls of standard circuits – `not`, calls of standard circuits are there",
  );
  assert.match(needs({ is: "tests-pass" }, situation([], { tests: 3, passed: 1, failed: 1 })), / – 1 of 3 fail$/);
  const wrong = situation([], { errors: 2, circuits: 0, problem: "no net is called `c`" });
  const first = "first, the error in the program: no net is called `c`; ";
  assert.equal(
    needs({ is: "tests-pass" }, wrong),
    `${first}all tests have been run and pass – the program has 2 errors`,
  );
  const lost = situation([], { written: { ...WRITTEN, kept: ["a b | q"] } });
  assert.match(needs({ is: "tests-kept" }, lost), / – missing: 0 1 \| 1$/);
  const robots: LessonCheck = { is: "counts", what: "robots", than: "<=", number: 1 };
  assert.equal(needs(robots, situation([], { robots: ["nor", "nor"] })), "the circuit has at most 1 robot – it has 2");
  // A step that has not been begun says so only to who asks.
  assert.deepEqual(missing(lesson([robots]), 0, situation([], { robots: ["nor", "nor"] })), []);
});

test("a search counts at once, and only the body of a niche that was clicked", () => {
  const body = ["343"];
  const niche = { niche: [0], fitness: [1, 1], body, behavior: "RRRL", function: "nand" } as EliteData;
  const niches = Array.from({ length: 5 }, () => niche);
  const old = { running: false, niches, chosen: null };
  assert.equal(is({ is: "evolving" }, situation([], { search: old })), false);
  assert.equal(is({ is: "evolving" }, situation([], { search: { ...old, running: true, niches: [] } })), true);
  assert.equal(is({ is: "counts", what: "niches", than: ">=", number: 5 }, situation([], { search: old })), true);
  assert.equal(is({ is: "counts", what: "niches", than: "=", number: 4 }, situation([], { search: old })), false);
  const design = { body, probe: null };
  assert.equal(is({ is: "niche-chosen" }, situation([], { search: old, design })), false);
  assert.equal(is({ is: "niche-chosen" }, situation([], { search: { ...old, chosen: niche }, design })), true);
});

test("a program is another one if more than comments has changed", () => {
  const changed = (text: string): boolean =>
    is({ is: "program-changed" }, situation([], { tests: 1, written: { ...WRITTEN, text } }));
  assert.equal(changed(WRITTEN.text), false);
  assert.equal(changed("test g"), true);
  assert.equal(is({ is: "program-changed" }, situation([], { tests: 1, written: null, isChecked: false })), false);
});

test("tests may get more rows, but keep those they have", () => {
  const kept = (lines: string[]): boolean =>
    is({ is: "tests-kept" }, situation([], { written: { ...WRITTEN, kept: lines } }));
  assert.equal(kept(WRITTEN.kept), true);
  assert.equal(kept(["1 1 | 0", ...WRITTEN.kept]), true);
  assert.equal(kept(WRITTEN.kept.slice(1)), false);
});

test("a size counts where the circuit is right, and the best has three stars", () => {
  const checks: LessonCheck[] = [{ is: "tests-pass" }, { is: "without", words: ["xor"] }];
  const gates = lesson(checks, { best: { number: 4, of: "gates" } });
  const right = situation([], { gates: 4, tests: 1, passed: 1, robots: ["nand", "nand"] });
  assert.equal(sizeOf(gates, right), 4);
  assert.equal(sizeOf({ ...gates, best: { number: 4, of: "robots" } }, right), 2);
  assert.equal(sizeOf({ ...gates, best: null }, right), null);
  assert.equal(sizeOf(gates, { ...right, passed: 0 }), null);
  assert.deepEqual(
    [3, 4, 5, 6, 7].map(size => starsOf(size, 4)),
    [3, 3, 2, 2, 1],
  );
  const progress = new Progress({}, {});
  assert.deepEqual(
    [progress.noteSize(gates, 5), progress.noteSize(gates, 6), progress.noteSize(gates, 4)],
    [true, false, true],
  );
  assert.equal(progress.size(gates), 4);
});

test("an output is lit whatever its name is", () => {
  const lit = (q: number): boolean => is({ is: "outputs-lit" }, situation([{ a: 1, q }], { outputs: ["q"] }));
  assert.deepEqual([lit(0), lit(1)], [false, true]);
});

test("a step says what it still needs as soon as a part of it is done, or a test was run", () => {
  const checks: LessonCheck[] = [{ is: "tests-pass" }, { is: "tests-kept" }];
  const one = lesson([], { steps: [{ task: "", checks, hints: [] }] });
  const needs = (given: Partial<Situation>): string[] => missing(one, 0, situation([], given));
  assert.deepEqual(needs({ tests: 1, passed: 1 }), []);
  assert.deepEqual(needs({ tests: 1, failed: 1 }), ["all tests have been run and pass – 1 of 1 fail"]);
  const kept = "every line of the lesson’s tests and claims is still there – missing: 0 1 | 1";
  assert.deepEqual(needs({ written: { ...WRITTEN, kept: ["a b | q"] }, tests: 1, passed: 1 }), [kept]);
  assert.deepEqual(needs({ tests: 1 }), [], "the task says enough");
  const robots = lesson([{ is: "robots-only", gates: ["nand"] }]);
  const built = situation([], { robots: ["nor"], tests: 1, passed: 1 });
  assert.deepEqual(missing(robots, 0, built), ["all robots of the circuit are nand – there is also nor"]);
});

test("a lesson is open under its own path and that of a learner of a class", () => {
  const one = lesson([]);
  for (const [path, expected] of [
    ["lesson_one.nb", true],
    ["lesson_one.Ada.nb", true],
    ["lesson_one_2.nb", false],
    ["lesson_one..nb", false],
    ["lesson_one.a/b.nb", false],
    ["other.nb", false],
  ] as const) {
    assert.equal(isLessonPath(one, path), expected, path);
  }
});

test("gates of the text are not taken for robots", () => {
  assert.equal(sizeText(1, "gates"), "1 gate in the text");
  assert.equal(sizeText(4, "robots"), "4 robots");
});

test("all claims must be proved, and a refuted one counts at once", () => {
  const is = (check: LessonCheck["is"], given: Partial<Situation>): boolean =>
    holds({ is: check } as LessonCheck, situation([], given), lesson([]));
  assert.equal(is("claims-proved", {}), false);
  assert.equal(is("claims-proved", { claims: 2, proved: 1 }), false);
  assert.equal(is("claims-proved", { claims: 2, proved: 2 }), true);
  assert.equal(is("claims-refuted", { claims: 2, proved: 1 }), false);
  assert.equal(is("claims-refuted", { claims: 2, refuted: 1 }), true);
  const open = missing(lesson([{ is: "claims-proved" }]), 0, situation([], { claims: 1, refuted: 1 }), true);
  assert.deepEqual(open, ["all that is claimed is proved – a property is refuted"]);
});
