import assert from "node:assert/strict";
import { test } from "node:test";

import { waveRows } from "../src/live/rows";
import { rowFor } from "../src/live/state_view";
import type { ShownSwarm } from "../src/protocol";

const SWARM = {
  inputs: [{ name: "clk", width: 1 }],
  outputs: [
    { name: "pc", width: 2 },
    { name: "done", width: 1 },
  ],
  shown: [{ robot: 1 }, { robot: 0 }, { robot: 4 }],
  robots: [
    { net: "pc[0]", label: "pc[0]" },
    { net: "pc[1]", label: "pc[1]" },
    { net: "b[0]", label: "b[0]" },
    { net: "n7", label: "nand(pc[0], clk)" },
    { net: "done", label: "done" },
  ],
  registers: [
    { name: "pc", robots: [1, 0] },
    { name: "b", robots: [2] },
  ],
} as unknown as ShownSwarm;

test("inputs and outputs come first, then registers by name, and robots when they are asked for", () => {
  const names = (opened: number[] | null, robots: "all" | number[]): string[] =>
    waveRows(SWARM, { opened, robots }).map(({ name, group }) => `${group} ${name}`);
  const always = ["input clk", "output pc", "output done"];
  assert.deepEqual(names(null, []), [...always, "register b"], "a register that is an output is there once");
  assert.deepEqual(names([0, 3], []), always, "a part has its own registers");
  assert.deepEqual(names(null, [3]), [...always, "register b", "robot nand(pc[0], clk)"]);
  assert.deepEqual(names([3, 4], "all"), [...always, "robot nand(pc[0], clk)"], "a lamp is a row already");
});

test("the first row that is for a value holds", () => {
  const rows = ["010", "0--", "1-1"].map((bits, line) => ({ bits, line, at: bits, text: "" }));
  assert.deepEqual(
    ["010", "011", "111", "110", "?00"].map(digits => rowFor(rows, digits)),
    [0, 1, 2, null, null],
  );
});
