import assert from "node:assert/strict";
import { test } from "node:test";

import { decodeFrame } from "../src/frame";
import { Playback } from "../src/live/playback";
import { encodeFrame } from "./encode";

/** A robot of one point that moves a voxel a cycle in `count` poses. */
function push(playback: Playback, now: number, running = true, rate = 4, count = 4): void {
  const frames = Array.from({ length: count }, (_, i) => [now === 0 ? 0 : Math.round((100 * (i + 1)) / count), 0]);
  const poses = [{ robot: 0, origin: Math.max(0, now - 1), frames }];
  const written = encodeFrame({ now, last: now, running, rate, robots: 1, poses, from: now + 1 });
  playback.push(decodeFrame(written, 0, 0));
}

function placeOf(playback: Playback): number {
  return playback.outline(0)?.[0] ?? NaN;
}

function near(found: number, expected: number): void {
  assert.ok(Math.abs(found - expected) < 0.01, `expected ${expected}, found ${found}`);
}

test("the start is shown until a cycle comes", () => {
  const playback = new Playback();
  push(playback, 0, false);
  assert.equal(playback.moving, false);
  near(placeOf(playback), 0);
});

test("a step is shown in real time", () => {
  const playback = new Playback();
  push(playback, 0, false);
  push(playback, 1, false);
  near(placeOf(playback), 0);
  for (const expected of [0.2, 0.4, 0.6, 0.8, 1]) {
    playback.advance(0.05);
    near(placeOf(playback), expected);
  }
  assert.equal(playback.moving, false);
});

test("motion is even across the border of two cycles", () => {
  const playback = new Playback();
  [0, 1, 2, 3].forEach(now => push(playback, now, false));
  let before = placeOf(playback);
  for (let i = 0; i < 30; i++) {
    playback.advance(0.0125);
    near(placeOf(playback) - before, 0.05);
    before = placeOf(playback);
  }
});

test("a running swarm is shown a little late, and never ahead", () => {
  const playback = new Playback();
  push(playback, 0, true);
  let shown = 0;
  for (let tick = 1; tick <= 400; tick++) {
    if (tick % 15 === 0) {
      push(playback, tick / 15, true);
    }
    playback.advance(1 / 60);
    assert.ok(playback.time >= shown && playback.time <= tick / 15);
    shown = playback.time;
  }
  assert.ok(400 / 15 - shown < 2, `it is at ${shown}`);
});

test("a rewind jumps", () => {
  const playback = new Playback();
  [0, 1, 2, 3, 4].forEach(now => push(playback, now, false));
  playback.advance(10);
  push(playback, 2, false);
  assert.equal(playback.time, 2);
  near(placeOf(playback), 2);
  assert.equal(playback.moving, false);
});

test("a page that was left behind jumps", () => {
  const playback = new Playback();
  push(playback, 0, true);
  push(playback, 50, true);
  assert.equal(playback.time, 50);
});

test("a robot that came into view later is drawn from what is known", () => {
  const playback = new Playback();
  push(playback, 5, false);
  assert.equal(playback.outline(7), null);
  near(placeOf(playback), 5);
});
