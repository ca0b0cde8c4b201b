import assert from "node:assert/strict";
import { test } from "node:test";

import { byFolder } from "../src/editor/files";
import { freePath } from "../src/free_path";

test("files are listed by their folders, the outer one first", () => {
  assert.deepEqual(byFolder(["b/x.nb", "a.nb", "b/c/y.nb", "a/z.nb", "c.nb"]), [
    ["", ["a.nb", "c.nb"]],
    ["a", ["a/z.nb"]],
    ["b", ["b/x.nb"]],
    ["b/c", ["b/c/y.nb"]],
  ]);
  assert.deepEqual(byFolder([]), [["", []]]);
});

test("a name that is taken gets a number", () => {
  const taken = new Set(["latch.nb", "latch_2.nb"]);
  assert.equal(
    freePath("latch.nb", name => taken.has(name)),
    "latch_3.nb",
  );
  assert.equal(
    freePath("new.nb", name => taken.has(name)),
    "new.nb",
  );
});
