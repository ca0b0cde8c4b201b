// The thread whose wave a robot carries.

import assert from "node:assert/strict";
import { test } from "node:test";

import { registerAt, threadAt, threadColor } from "../src/live/waves";
import type { ShownWaves } from "../src/protocol";

const MACHINE: ShownWaves = { step: 3, beat: 1, threads: 3, phases: [0, 1, 4], begins: 4, clock: 0, registers: [] };

function threads(waves: ShownWaves, robot: number, cycles: number): (number | null)[] {
  return Array.from({ length: cycles + 1 }, (_, cycle) => threadAt(waves, robot, cycle));
}

test("a robot carries the waves of the threads in turn", () => {
  // The first step of the first thread begins in the fifth cycle.
  assert.deepEqual(threads(MACHINE, 0, 8), [null, 2, 0, 1, 2, 0, 1, 2, 0]);
  assert.equal(threadAt(MACHINE, 0, 5), 0);
});

test("a phase is a delay", () => {
  for (const cycle of [1, 5, 6, 7, 100]) {
    assert.equal(threadAt(MACHINE, 1, cycle + 1), threadAt(MACHINE, 0, cycle));
    assert.equal(threadAt(MACHINE, 2, cycle + 4), threadAt(MACHINE, 0, cycle));
  }
});

test("a thread lasts for a beat", () => {
  const slow = { ...MACHINE, step: 6, beat: 2, begins: 8 };
  assert.deepEqual(threads(slow, 0, 14).slice(7), [2, 2, 0, 0, 1, 1, 2, 2]);
});

test("what is no robot carries nothing", () => {
  assert.equal(threadAt(MACHINE, 3, 7), null);
});

test("threads beyond the last color begin with the first again", () => {
  assert.deepEqual([0, 7, 8, 15, 16].map(threadColor), [1, 8, 1, 8, 1]);
});

test("a register has the bits of the last step that all of them have done", () => {
  // The second bit is seen a cycle later than the first; both start at 1.
  const bits = [-3, -2].map((after, robot) => ({ source: { robot }, after, starts: [true] }));
  const seen = (thread: number, cycle: number): number[] | null =>
    registerAt(MACHINE, { name: "n", bits }, { thread, cycle }, (source, of) => 100 * of + Object.values(source)[0]);
  // The first step of the first thread is seen at the end of the fifth cycle and of the sixth.
  assert.deepEqual(seen(0, 0), [1, 1]);
  assert.deepEqual(seen(0, 5), [1, 1]);
  assert.deepEqual(seen(0, 6), [500, 601]);
  assert.deepEqual(seen(0, 8), [500, 601]);
  assert.deepEqual(seen(0, 9), [800, 901]);
  assert.deepEqual(seen(1, 9), [600, 701]);
  const unknown = { name: "n", bits: bits.map(bit => ({ ...bit, starts: [] })) };
  assert.equal(
    registerAt(MACHINE, unknown, { thread: 0, cycle: 2 }, () => 1),
    null,
  );
  assert.equal(
    registerAt(MACHINE, { name: "n", bits }, { thread: 0, cycle: 9 }, () => null),
    null,
  );
});
