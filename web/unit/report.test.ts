import assert from "node:assert/strict";
import { test } from "node:test";

import { pathTo } from "../src/live/schematic_parts";
import { Nets } from "../src/report/nets";
import { fittest } from "../src/report/niches";
import { gaitOf, isUnstable } from "../src/report/data";
import { outlineAt } from "../src/robots/gait";

/** Two robots after each other, the second of which reads its own net, too. */
const CELLS = [
  { net: "x", function: "and", about: [], reads: ["a", "b"] },
  { net: "q", function: "or", about: [], reads: ["x", "q"] },
];

test("a robot is marked with its wires, or with all before or after it", () => {
  const nets = new Nets(CELLS);
  assert.equal(nets.driver("q"), 1);
  assert.equal(nets.driver("a"), undefined);
  assert.deepEqual(nets.inputs(), ["a", "b"]);
  assert.deepEqual([...nets.reached(["q"], "wires")], ["q", "x"]);
  assert.deepEqual([...nets.reached(["x", "q"], "wires")], ["x", "q"], "several together have no wires");
  assert.deepEqual([...nets.reached(["q"], "before")], ["q", "x", "a", "b"]);
  assert.deepEqual([...nets.reached(["a"], "after")], ["a", "x", "q"]);
  assert.deepEqual([...nets.reached([], "after")], []);
});

test("a niche of two axes has the fittest of all along the others", () => {
  const elites = [
    { behavior: "RL", niche: [0, 1, 0], fitness: [1] },
    { behavior: "RL", niche: [0, 1, 2], fitness: [3] },
    { behavior: "RL", niche: [0, 1, 1], fitness: [2] },
    { behavior: "LR", niche: [0, 1, 0], fitness: [0] },
  ];
  const best = fittest(elites, 0, 1);
  assert.deepEqual(
    [...best],
    [
      ["RL 0 1", 1],
      ["LR 0 1", 3],
    ],
  );
  assert.equal(fittest(elites, -1, -1).get("RL 0 0"), 1, "without axes there is one niche");
});

test("a recorded body walks from frame to frame", () => {
  const frames = Buffer.from(Int16Array.from([0, 0, 50, 10, 100, 20]).buffer).toString("base64");
  const gait = gaitOf({ size: [1, 1], voxels: [], corners: 1, frames }, 2);
  assert.equal(gait.cycles, 1);
  assert.deepEqual([...outlineAt(gait, 0.25)], [0.25, 0.05].map(Math.fround));
  assert.deepEqual([...outlineAt(gait, 5)], [1, 0.2].map(Math.fround));
});

test("the path to a sheet begins with the whole", () => {
  const sheet = (outer: number | null) => ({ name: "", about: "", outer, svg: "", bundles: [] });
  assert.deepEqual(pathTo([sheet(null), sheet(0), sheet(1)], 2), [0, 1, 2]);
});

test("a robot is unstable from its fault on, or at the end of what was recorded before it", () => {
  const swarm = { pace: 12, cycles: 3 };
  assert.ok(!isUnstable(null, 3, swarm));
  assert.deepEqual(
    [1.9, 2, 3].map(time => isUnstable(24, time, swarm)),
    [false, true, true],
  );
  assert.deepEqual(
    [2.9, 3].map(time => isUnstable(41, time, swarm)),
    [false, true],
  );
  assert.ok(isUnstable(5, 0, { pace: 12, cycles: 0 }), "in the first cycle");
});
