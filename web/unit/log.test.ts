import assert from "node:assert/strict";
import { test } from "node:test";

import { decodeFrame } from "../src/frame";
import { RunLog } from "../src/log";
import { encodeFrame } from "./encode";

/** Cycles `from` to `to` of a run with one input, whose bit and place tell the runs apart. */
function push(log: RunLog, from: number, to: number, bit: number, last = to, first = 0): void {
  const cycles = Array.from({ length: Math.max(0, to - from + 1) }, (_, i) => ({
    inputs: [bit],
    robots: [bit],
    outputs: [bit],
    places: [from + i],
  }));
  log.merge(decodeFrame(encodeFrame({ now: to, last, first, from, log: cycles, robots: 1 }), 1, 1));
}

function bits(log: RunLog): string {
  return Array.from({ length: log.last }, (_, i) => log.at(i + 1)?.inputs[0] ?? "-").join("");
}

test("cycles are appended", () => {
  const log = new RunLog();
  push(log, 1, 3, 0);
  push(log, 4, 5, 1);
  assert.equal(bits(log), "00011");
  assert.equal(log.at(4)?.places[0], 4);
  assert.equal(log.at(0), undefined);
  assert.equal(log.at(6), undefined);
});

test("a seek forgets nothing", () => {
  const log = new RunLog();
  push(log, 1, 5, 0);
  push(log, 6, 5, 0, 5);
  assert.equal(bits(log), "00000");
});

test("a cycle run from an earlier moment replaces what came after it", () => {
  const log = new RunLog();
  push(log, 1, 5, 0);
  push(log, 3, 3, 1);
  assert.equal(log.last, 3);
  assert.equal(bits(log), "001");
});

test("a new start replaces everything", () => {
  const log = new RunLog();
  push(log, 1, 5, 0);
  push(log, 1, 0, 0, 0);
  assert.equal(log.last, 0);
  assert.equal(log.at(1), undefined);
  push(log, 1, 2, 1);
  assert.equal(bits(log), "11");
});

test("a page that comes late knows only what it was sent", () => {
  const log = new RunLog();
  push(log, 900, 902, 1, 902, 500);
  assert.equal(log.at(899), undefined);
  assert.equal(log.at(900)?.inputs[0], 1);
});

test("cycles before the first are dropped, however long it runs", () => {
  const log = new RunLog();
  for (let cycle = 1; cycle <= 3000; cycle++) {
    push(log, cycle, cycle, cycle % 2, cycle, Math.max(0, cycle - 1000));
  }
  assert.equal(log.at(1500), undefined);
  assert.equal(log.at(2001)?.places[0], 2001);
  assert.equal(log.at(3000)?.places[0], 3000);
});
