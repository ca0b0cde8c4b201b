import assert from "node:assert/strict";
import { test } from "node:test";

import { decodeFrame, isFrameOf, unpackBits, type Frame } from "../src/frame";
import { encodeFrame } from "./encode";

test("bits are unpacked from the lowest of the first byte", () => {
  assert.deepEqual([...unpackBits(new Uint8Array([0b0000_0101, 0b1]), 9)], [1, 0, 1, 0, 0, 0, 0, 0, 1]);
});

test("a frame is what was written", () => {
  const buffer = encodeFrame({
    now: 7,
    first: 2,
    last: 9,
    rate: 3.5,
    running: true,
    number: 258,
    from: 7,
    log: [
      { inputs: [1, 0], robots: [0, 1, 1], outputs: [1], places: [0.5, -1.25, 3] },
      { inputs: [0, 1], robots: [1, 0, 0], outputs: [0], places: [1.5, -2, 4] },
    ],
    poses: [
      {
        robot: 2,
        origin: -4.5,
        frames: [
          [0, 0, 100, 50],
          [10, 0, 110, 50],
        ],
      },
    ],
  });
  const frame = decodeFrame(buffer, 2, 1);
  assert.deepEqual(
    [frame.now, frame.first, frame.last, frame.rate, frame.running, frame.from],
    [7, 2, 9, 3.5, true, 7],
  );
  assert.deepEqual([...(frame.log[1]?.robots ?? [])], [1, 0, 0]);
  assert.deepEqual([...(frame.log[0]?.inputs ?? [])], [1, 0]);
  assert.deepEqual([...(frame.log[0]?.places ?? [])], [0.5, -1.25, 3]);
  const poses = frame.poses.get(2);
  assert.equal(poses?.points, 2);
  assert.equal(poses?.origin, -4.5);
  assert.deepEqual([...(poses?.coordinates ?? [])], [0, 0, 100, 50, 10, 0, 110, 50]);
});

test("a frame belongs to the swarm with its number", () => {
  const buffer = encodeFrame({ number: 258, log: [{ inputs: [], robots: [0, 1], outputs: [], places: [0, 0] }] });
  assert.equal(isFrameOf(buffer, { number: 2, robots: [0, 0] }), true);
  assert.equal(isFrameOf(buffer, { number: 3, robots: [0, 0] }), false);
  assert.equal(isFrameOf(buffer, { number: 258, robots: [0] }), false);
});

test("a message of another kind is refused", () => {
  const buffer = encodeFrame({});
  new DataView(buffer).setUint8(0, 9);
  assert.throws((): Frame => decodeFrame(buffer, 0, 0), /unknown kind/);
});
