import assert from "node:assert/strict";
import { test } from "node:test";

import { truthRows } from "../src/live/truth";
import type { StimulusSource, ShownSwarm } from "../src/protocol";

interface Given {
  inputs: [string, number][];
  robots: [string, StimulusSource[]][];
  shown: StimulusSource[];
  waves?: object;
}

function swarm({ inputs, robots, shown, waves }: Given): ShownSwarm {
  return {
    inputs: inputs.map(([name, width]) => ({ name, width })),
    robots: robots.map(([name, senses]) => ({ function: name, senses })),
    shown,
    waves: waves ?? null,
  } as unknown as ShownSwarm;
}

const input = (bit: number): StimulusSource => ({ input: bit });
const robot = (index: number): StimulusSource => ({ robot: index });
const no: StimulusSource = { constant: false };

test("the rows of a circuit without state are those of its gates, whatever the order of its robots", () => {
  const half: Given = {
    inputs: [
      ["a", 1],
      ["b", 1],
    ],
    robots: [
      ["not", [robot(1), no]],
      ["xnor", [input(0), input(1)]],
      ["and", [input(0), input(1)]],
    ],
    shown: [robot(0), robot(2), input(1)],
  };
  assert.deepEqual(truthRows(swarm(half)), [
    { inputs: "00", outputs: "000" },
    { inputs: "01", outputs: "101" },
    { inputs: "10", outputs: "100" },
    { inputs: "11", outputs: "011" },
  ]);
});

test("a robot of three stimuli has the first as its highest bit", () => {
  const mux: Given = {
    inputs: [
      ["s", 1],
      ["d", 2],
    ],
    robots: [["mux", [input(0), input(1), input(2)]]],
    shown: [robot(0)],
  };
  assert.equal(
    truthRows(swarm(mux))
      ?.map(row => row.outputs)
      .join(""),
    "01010011",
  );
});

test("there is no table with a state, too many inputs, or none", () => {
  const loop: Given = { inputs: [["a", 1]], robots: [["nand", [input(0), robot(0)]]], shown: [robot(0)] };
  assert.equal(truthRows(swarm(loop)), null);
  const buffer = (bits: number): Given => ({
    inputs: [["a", bits]],
    robots: [["buf", [input(0), no]]],
    shown: [robot(0)],
  });
  assert.equal(truthRows(swarm(buffer(5)))?.length, 32);
  assert.equal(truthRows(swarm(buffer(6))), null);
  assert.equal(truthRows(swarm({ inputs: [], robots: [], shown: [no] })), null);
  assert.equal(truthRows(swarm({ ...buffer(2), waves: { clock: 0 } })), null, "the registers of a wave machine");
  assert.equal(truthRows(swarm({ ...buffer(2), robots: [["?", [input(0), no]]] })), null);
});
