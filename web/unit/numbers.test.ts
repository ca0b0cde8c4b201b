import assert from "node:assert/strict";
import { test } from "node:test";

import { numberText, typedNumber, type NumberFormat } from "../src/live/numbers";

const LIGHT = {
  width: 2,
  members: [
    ["green", "00"],
    ["yellow", "01"],
    ["red", "11"],
  ] as [string, string][],
};

test("a value is written by name, decimal, hexadecimal or with a sign", () => {
  const all = (value: bigint, valued: { width: number }): string[] =>
    (["names", "decimal", "hex", "signed"] as NumberFormat[]).map(format => numberText(value, valued, format));
  assert.deepEqual(all(3n, LIGHT), ["red", "3", "0x3", "-1"]);
  assert.deepEqual(all(2n, LIGHT), ["2", "2", "0x2", "-2"], "a value that is no member");
  assert.deepEqual(all(31n, { width: 9 }), ["31", "31", "0x01f", "31"]);
  assert.equal(numberText(1n << 69n, { width: 70 }, "signed"), String(-(1n << 69n)));
});

test("typed numbers and members are understood or refused", () => {
  const typed = (text: string): bigint | null => typedNumber(text, { width: 5 });
  assert.deepEqual([" 5 ", "0b101", "0x1F", "-3", "-16"].map(typed), [5n, 5n, 31n, 29n, 16n]);
  assert.deepEqual(["", "32", "-17", "1.5", "five", "0b2", "--1"].map(typed), Array(7).fill(null));
  assert.equal(typedNumber("yellow", LIGHT), 1n);
  assert.equal(typedNumber("blue", LIGHT), null);
});
