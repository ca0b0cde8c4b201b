import assert from "node:assert/strict";
import { test } from "node:test";

import { matches } from "../src/robots/match";

const NAND = { name: "nand", function: "nand", behavior: "RRRL" };
const MUX = { name: "choose", function: "mux", behavior: "LRLRLLRR" };

test("robots are found by name, gate and letters, in any case", () => {
  assert.ok(matches(NAND, "") && matches(NAND, "  NAND ") && matches(NAND, "rrrl") && matches(NAND, "a NAND b"));
  assert.ok(matches(MUX, "mux") && matches(MUX, "? b") && matches(MUX, "choose mux"));
  assert.ok(!matches(NAND, "nor") && !matches(MUX, "choose nand"));
});
