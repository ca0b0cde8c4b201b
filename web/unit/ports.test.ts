import assert from "node:assert/strict";
import { test } from "node:test";

import { bitsOf, keepBits, offsetOf, toBits, toNumber, totalWidth, withBit } from "../src/ports";

const ports = [
  { name: "a", width: 3 },
  { name: "clk", width: 1 },
  { name: "b", width: 2 },
];

test("bits are named from the most significant of each port", () => {
  assert.deepEqual(
    bitsOf(ports).map(bit => bit.name),
    ["a[2]", "a[1]", "a[0]", "clk", "b[1]", "b[0]"],
  );
  assert.deepEqual(
    bitsOf(ports).map(bit => bit.index),
    [0, 1, 2, 3, 4, 5],
  );
  assert.equal(totalWidth(ports), 6);
  assert.equal(offsetOf(ports, ports[2] as (typeof ports)[0]), 4);
});

test("numbers become bits and bits numbers", () => {
  assert.deepEqual(toBits(6n, 4), [0, 1, 1, 0]);
  assert.equal(toNumber([0, 1, 1, 0]), 6n);
  for (let value = 0n; value < 64n; value++) {
    assert.equal(toNumber(toBits(value, 6)), value);
  }
  const wide = (1n << 70n) + 5n;
  assert.equal(toNumber(toBits(wide, 80)), wide);
});

test("one bit changes", () => {
  assert.equal(withBit("0000", 2, 1), "0010");
});

test("inputs of the same name and width keep their values", () => {
  const after = [
    { name: "b", width: 2 },
    { name: "a", width: 4 },
    { name: "clk", width: 1 },
  ];
  assert.equal(keepBits("101110", ports, after), "1000001");
  assert.equal(keepBits("", [], after), "0000000");
});
