import assert from "node:assert/strict";
import { test } from "node:test";

import { fitText, wrapCall } from "../src/live/labels";
import { Viewport } from "../src/live/viewport";

function pane(width: number, height: number): Viewport {
  const view = new Viewport();
  Object.assign(view, { width, height });
  return view;
}

test("the whole is seen between its margins, which may depend on the scale", () => {
  const view = pane(400, 300);
  view.fit({ x: 50, y: 10, width: 1000, height: 100 }, scale => ({
    left: scale < 0.5 ? 60 : 0,
    right: 40,
    top: 0,
    bottom: 0,
  }));
  assert.equal(view.scale, 0.3);
  assert.ok(Math.abs((50 - view.box.x) * view.scale - 60) < 1e-9, "it begins after its left margin");
  assert.equal(Math.round(view.box.width * view.scale), 400);
  assert.ok(view.isWhole);
});

test("what is zoomed at stays where it is", () => {
  const view = pane(400, 300);
  view.fit({ x: 0, y: 0, width: 800, height: 600 }, () => ({ left: 0, right: 0, top: 0, bottom: 0 }));
  const place = (): [number, number] => [view.box.x + 100 / view.scale, view.box.y + 50 / view.scale];
  const before = place();
  view.zoom(2, 100, 50);
  assert.equal(view.scale, 1);
  assert.deepEqual(place(), before);
  assert.ok(!view.isWhole);
  view.zoom(1000, 100, 50);
  assert.equal(view.scale, 4, "there is a largest scale");
  view.zoom(1e-6);
  assert.equal(view.scale, 0.25, "and a smallest one, half of the whole");
});

test("a text has whole words, and is left out when there is room for none", () => {
  const width = (text: string): number => 10 * text.length;
  assert.equal(fitText("register", 80, width), "register");
  assert.equal(fitText("register", 70, width), "");
  assert.equal(fitText("pc/a/next_q", 70, width), "…next_q");
  assert.equal(fitText("pc/a[12]", 50, width), "…[12]");
  const call = "q = xor(and(a, b), c)";
  assert.deepEqual(wrapCall(call, 210, 1, width), [call]);
  assert.deepEqual(wrapCall(call, 150, 2, width), ["q = xor(and(a, ", "b), c)"]);
  assert.deepEqual(wrapCall(call, 80, 4, width), ["q = xor(", "and(a, ", "b), c)"]);
  assert.equal(wrapCall(call, 80, 2, width), null);
  assert.equal(wrapCall(call, 30, 9, width), null);
});
