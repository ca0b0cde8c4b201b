import assert from "node:assert/strict";
import { test } from "node:test";

import type { PaletteEntry } from "../src/protocol";
import {
  countVoxels,
  drawnFrom,
  emptyBody,
  isConnected,
  mirrored,
  paint,
  randomBody,
  resized,
  swappedInputs,
} from "../src/robots/body";
import { History } from "../src/robots/history";

const names = ["bone", "flesh", "muscle", "antimuscle", "s1_shrink", "s2_shrink", "s1_grow", "s2_grow"];
const palette: PaletteEntry[] = names.map((name, i) => ({ code: String(i + 1), name, about: name, look: i }));

test("painting changes one voxel and nothing outside", () => {
  const body = paint(emptyBody(3, 2), 1, 0, "3");
  assert.deepEqual(body, ["030", "000"]);
  assert.equal(paint(body, 1, 0, "3"), body);
  assert.equal(paint(body, 3, 0, "3"), body);
  assert.equal(countVoxels(body), 1);
});

test("a body keeps its feet and its left side in a box of another size", () => {
  assert.deepEqual(resized(["12", "34"], 3, 3), ["000", "120", "340"]);
  assert.deepEqual(resized(["123", "456"], 2, 1), ["45"]);
});

test("mirroring twice changes nothing", () => {
  const body = ["012", "345"];
  assert.deepEqual(mirrored(body), ["210", "543"]);
  assert.deepEqual(mirrored(mirrored(body)), body);
});

test("swapping inputs exchanges the materials of the two stimuli", () => {
  assert.deepEqual(swappedInputs(["1234", "5678"], palette), ["1234", "6587"]);
  const own: PaletteEntry[] = [
    { code: "9", name: "my_s1_slow", about: "", look: 0 },
    { code: "a", name: "my_s2_slow", about: "", look: 1 },
  ];
  assert.deepEqual(swappedInputs(["9a1"], own), ["a91"]);
});

test("voxels are connected by their sides only", () => {
  assert.equal(isConnected(["110", "011"]), true);
  assert.equal(isConnected(["10", "01"]), false);
  assert.equal(isConnected(["00"]), false);
});

test("random bodies are connected, stand, and have the three muscles without which a body is invalid", () => {
  let state = 1;
  const random = (): number => (state = (state * 16807) % 2147483647) / 2147483647;
  for (let i = 0; i < 200; i++) {
    const [width, height] = [1 + (i % 10), 1 + (i % 7)];
    const body = randomBody(width, height, palette, random);
    assert.ok(isConnected(body), body.join("/"));
    const muscles = [...body.join("")].filter(code => "34".includes(code)).length;
    assert.ok(muscles >= Math.min(3, width * height), body.join("/"));
    assert.match(body.at(-1) ?? "", /[1-8]/);
  }
});

test("a random body senses a third stimulus only after one that does", () => {
  const third: PaletteEntry[] = ["s3_shrink", "s3_grow"].map((name, i) => ({
    code: "9a"[i] as string,
    name,
    about: name,
    look: 8 + i,
  }));
  const all = [...palette, ...third];
  assert.deepEqual(drawnFrom(["345"], all), palette);
  assert.deepEqual(drawnFrom(["3a5"], all), all);
});

test("steps are undone and done again, and a stroke is one step", () => {
  const history = new History("a");
  history.push("b");
  history.push("c", true);
  history.push("d");
  history.undo();
  assert.equal(history.present, "c");
  history.undo();
  assert.equal(history.present, "a");
  assert.equal(history.canUndo, false);
  history.redo();
  assert.equal(history.present, "c");
  history.push("e");
  assert.equal(history.canRedo, false);
  history.push("e");
  history.undo();
  assert.equal(history.present, "c");
});
