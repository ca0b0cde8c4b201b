// What the environment of a test shows in a cycle.

import assert from "node:assert/strict";
import { test } from "node:test";

import { memoryRows, readAt, screenAt, wordAt } from "../src/live/environment";
import type { ShownMemory } from "../src/protocol";

const MEMORY: ShownMemory = {
  name: "words",
  width: 8,
  size: 4,
  words: ["48", "0", "ff"],
  reads: [
    [
      [0, 0],
      [9, 3],
    ],
  ],
  writes: [
    [5, 1, "a"],
    [12, 1, "b"],
  ],
};

test("what is written appears in the first cycle after it", () => {
  const screen: [number, string][] = [
    [5, "H"],
    [12, "i"],
  ];
  assert.deepEqual(
    [0, 5, 6, 12, 13].map(cycle => screenAt(screen, cycle)),
    ["", "", "H", "H", "Hi"],
  );
  assert.deepEqual(
    [5, 6, 13].map(cycle => wordAt(MEMORY, 1, cycle)),
    [0n, 10n, 11n],
  );
});

test("a memory reads from the start on", () => {
  assert.deepEqual(
    [0, 1, 9, 10].map(cycle => readAt(MEMORY, cycle)),
    [[0], [0], [0], [3]],
  );
});

test("a memory has the words that it began with, was given or reads", () => {
  const shown = (cycle: number): string[] =>
    memoryRows(MEMORY, cycle).rows.map(
      ({ at, value, isRead, isWritten }) => `${at}=${value}${isRead ? " read" : ""}${isWritten ? " written" : ""}`,
    );
  assert.deepEqual(shown(0), ["0=72 read", "1=0", "2=255"]);
  assert.deepEqual(shown(10), ["0=72", "1=10 written", "2=255", "3=0 read"]);
});

test("words of one bit are numbers, the lowest address the lowest bit", () => {
  const writes: [number, number, string][] = [32, 33, 35].map(address => [0, address, "1"]);
  const bits = { ...MEMORY, width: 1, size: 64, words: [], reads: [], writes };
  assert.deepEqual(memoryRows(bits, 1), {
    rows: [{ at: 1, value: 11n, width: 32, isRead: false, isWritten: true }],
    left: 0,
  });
});

test("of a large memory those words are shown that are near what is read", () => {
  const words = Array.from({ length: 1000 }, (_, at) => at.toString(16));
  const { rows, left } = memoryRows({ ...MEMORY, size: 1000, words, writes: [], reads: [[[0, 500]]] }, 1);
  assert.deepEqual([rows.length, left, rows[32]?.at, rows[32]?.isRead], [64, 936, 500, true]);
});
