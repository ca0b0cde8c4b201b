import assert from "node:assert/strict";
import { test } from "node:test";

import type { EliteData } from "../src/protocol";
import { GATES, gateName, gateOf, lettersOf, patterns, truthTable } from "../src/gate";
import { decodeGait, outlineAt } from "../src/robots/gait";
import { Archive } from "../src/robots/archive";

function encode(numbers: number[]): string {
  return Buffer.from(Int16Array.from(numbers).buffer).toString("base64");
}

test("a gait has the pose at the start and those of all cycles", () => {
  // One point, two poses in a cycle, two cycles.
  const gait = decodeGait({ frames: 2, cycles: 2, poses: encode([0, 0, 50, 0, 100, 0, 150, 0, -200, 0]) });
  assert.equal(gait.points, 1);
  assert.deepEqual([...outlineAt(gait, 0)], [0, 0]);
  assert.deepEqual([...outlineAt(gait, 0.25)], [0.25, 0]);
  assert.deepEqual([...outlineAt(gait, 1)], [1, 0]);
  assert.deepEqual([...outlineAt(gait, 2)], [-2, 0]);
  assert.deepEqual([...outlineAt(gait, 99)], [-2, 0]);
});

test("gates have distinct behaviors and names", () => {
  assert.equal(new Set(GATES.map(gate => gate.behavior)).size, GATES.length);
  assert.equal(new Set(GATES.map(gate => gate.name)).size, GATES.length - 2, "constants of two and three inputs");
  assert.equal(GATES.filter(gate => gate.behavior.length === 4).length, 16);
  assert.deepEqual(truthTable("nand"), [1, 1, 1, 0]);
  assert.equal(gateOf("RRRL"), "nand");
  assert.equal(gateOf("R?RL"), null);
  assert.equal(gateName(null), "no gate");
});

test("gates of three stimuli have eight outputs", () => {
  assert.deepEqual(patterns(4), ["00", "01", "10", "11"]);
  assert.deepEqual(patterns(8), ["000", "001", "010", "011", "100", "101", "110", "111"]);
  assert.deepEqual(truthTable("maj"), [0, 0, 0, 1, 0, 1, 1, 1]);
  assert.deepEqual(truthTable("f3_1e"), [0, 1, 1, 1, 1, 0, 0, 0]);
  assert.equal(truthTable("f3_1"), null);
  assert.equal(gateOf("LLLRLRRR"), "maj");
  assert.equal(lettersOf(0xca, 8), "LRLRLLRR");
});

test("niches of an archive open and improve", () => {
  const archive = new Archive();
  const known = { niche: [1, 0, 14], fitness: [1, 0.5], body: ["3"], behavior: "RRRL", function: "nand" };
  const niche = known as EliteData;
  const event = { event: "archive" as const, id: 1, generation: 1, evaluations: 8, niches: [niche] };
  const axes = [
    { name: "voxels", bins: 3 },
    { name: "active", bins: 3 },
    { name: "behavior", bins: 16 },
  ];
  archive.merge({ ...event, axes });
  archive.merge({ ...event, axes, generation: 2, niches: [{ ...niche, fitness: [1, 0.75] }] });
  assert.equal(archive.niches.size, 1);
  assert.equal(archive.best(), 0.75);
  assert.deepEqual(archive.split(), { across: [0, 1], layers: [2] });
  assert.equal(archive.places([2]).length, 16);
  archive.merge({
    ...event,
    axes: [
      { name: "behavior", bins: 16 },
      { name: "active", bins: 8 },
    ],
  });
  assert.deepEqual(archive.split(), { across: [1], layers: [0] });
  assert.equal(archive.places([]).length, 1);
});
