import assert from "node:assert/strict";
import { test } from "node:test";

import { takenName, type Taken } from "../src/taken_names";

test("files of different things have different names", () => {
  const latch = { circuit: "latch", swarm: null };
  const all: Taken[] = [
    { ...latch, what: "page", ending: "html", cycles: [1, 40] },
    { ...latch, what: "page", ending: "html", cycles: [2, 41] },
    { ...latch, what: "live", ending: "html" },
    { ...latch, what: "recorded", ending: "html" },
    { ...latch, what: "schematic", ending: "svg" },
    { ...latch, what: "svg", ending: "svg", cycles: [1, 40] },
    { ...latch, what: "png", ending: "png", cycles: [1, 40] },
    { circuit: "latch", swarm: "few", what: "svg", ending: "svg", cycles: [1, 40] },
  ];
  assert.equal(new Set(all.map(takenName)).size, all.length);
  assert.equal(takenName(all[7] as Taken), "latch-few-spacetime-1-40.svg");
  assert.equal(
    takenName({ circuit: "adder[4]", swarm: null, what: "csv", ending: "csv", cycles: [1, 8] }),
    "adder_4-cycles-1-8.csv",
  );
});
