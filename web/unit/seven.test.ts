// Bytes as text of a document.

import assert from "node:assert/strict";
import { test } from "node:test";

import { bytesOf, textOf } from "../src/tab/seven";

test("all bytes come back", () => {
  const all = Uint8Array.from({ length: 65_536 }, (_, i) => (i & 1 ? i >> 8 : i >> 1));
  const runs = [0, 0x0d, 0x3c, 0xff, 0x1a].map(byte => new Uint8Array(100).fill(byte));
  for (const bytes of [all, ...runs, ...[0, 1, 2, 6, 7, 8, 9].map(length => all.slice(512, 512 + length))]) {
    assert.deepEqual(bytesOf(textOf(bytes)), bytes);
  }
});

test("a document leaves the text as it is", () => {
  const zeros = textOf(new Uint8Array(1000));
  assert.doesNotMatch(zeros, /[\0\r<]/);
  assert.ok(
    [...zeros].every(letter => letter.codePointAt(0)! < 0x800),
    "two bytes at most",
  );
  const bytes = Uint8Array.from({ length: 10_000 }, (_, i) => (i * 7919) >> 3);
  const size = new TextEncoder().encode(textOf(bytes)).length;
  assert.doesNotMatch(textOf(bytes), /[\0\r<]/);
  assert.ok(size < 11_700, `${size} bytes`);
});
