// Writes frames as the server does (docs/play-protocol.md).

import type { Frame } from "../frame";

const HEADER = 32;

/** The message of a frame about the swarm with this number. */
export function encodeFrame(frame: Frame, number: number): ArrayBuffer {
  const packed = (bits: Uint8Array): number => Math.ceil(bits.length / 8);
  const logged = frame.log.reduce(
    (sum, { inputs, robots, outputs }) => sum + packed(inputs) + packed(robots) + packed(outputs) + 4 * frame.robots,
    0,
  );
  const posed = [...frame.poses.values()].reduce((sum, { coordinates }) => sum + 8 + 2 * coordinates.length, 0);
  const view = new DataView(new ArrayBuffer(HEADER + logged + posed));
  view.setUint8(0, 1);
  view.setUint8(1, frame.posesPerCycle);
  view.setUint16(2, frame.robots, true);
  view.setUint32(4, frame.now, true);
  view.setUint32(8, frame.first, true);
  view.setUint32(12, frame.last, true);
  view.setFloat32(16, frame.rate, true);
  view.setUint8(20, Number(frame.running));
  view.setUint8(21, number & 255);
  view.setUint32(24, frame.from, true);
  view.setUint16(28, frame.log.length, true);
  view.setUint16(30, frame.poses.size, true);
  let at = HEADER;
  for (const { inputs, robots, outputs, places } of frame.log) {
    for (const bits of [inputs, robots, outputs]) {
      bits.forEach((bit, i) => view.setUint8(at + (i >> 3), view.getUint8(at + (i >> 3)) | (bit << (i & 7))));
      at += packed(bits);
    }
    for (const place of places) {
      view.setFloat32(at, place, true);
      at += 4;
    }
  }
  for (const [robot, { points, origin, coordinates }] of frame.poses) {
    view.setUint16(at, robot, true);
    view.setUint16(at + 2, points, true);
    view.setFloat32(at + 4, origin, true);
    coordinates.forEach((coordinate, i) => view.setInt16(at + 8 + 2 * i, coordinate, true));
    at += 8 + 2 * coordinates.length;
  }
  return view.buffer as ArrayBuffer;
}
