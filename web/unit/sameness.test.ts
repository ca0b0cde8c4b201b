import assert from "node:assert/strict";
import { test } from "node:test";

import { withEnding } from "../src/editor/files";
import { sameProgram } from "../src/sameness";

test("comments and space do not make another program", () => {
  assert.equal(sameProgram("q = a // and\n\n", "// first\n  q =  a"), true);
  assert.equal(sameProgram("q = a", "q = b"), false);
  assert.equal(sameProgram('test t "a // b" {', 'test t "a // c" {'), false);
});

test("a program's name has its ending once", () => {
  assert.equal(withEnding("adder"), "adder.nb");
  assert.equal(withEnding(" a/b.nb "), "a/b.nb");
  assert.equal(withEnding("  "), null);
});
