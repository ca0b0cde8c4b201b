// The binary message that the server sends after a cycle.

export interface LoggedCycle {
  inputs: Uint8Array;
  robots: Uint8Array;
  outputs: Uint8Array;
  /** The place of each robot's center of mass at the end of the cycle, in voxels from its start. */
  places: Float32Array;
  /** Robots whose bits changed within the cycle, and the shares of it after which they did, in order. */
  flips: [robot: number, after: number][];
}

export interface Poses {
  points: number;
  /** Voxels from the robot's start, to which the points are relative. */
  origin: number;
  /** Hundredths of a voxel: x and y of each point, frame after frame. */
  coordinates: Int16Array;
}

export interface Frame {
  posesPerCycle: number;
  robots: number;
  now: number;
  first: number;
  last: number;
  rate: number;
  running: boolean;
  /** The number of the first cycle of `log`, from 1. Whatever was logged from there on is forgotten. */
  from: number;
  log: LoggedCycle[];
  poses: Map<number, Poses>;
}

const FRAME = 1;
const HEADER = 32;
/** Env steps of a cycle. */
export const CYCLE_STEPS = 84;

/** Reads a frame of a swarm with these numbers of input and output bits. */
export function decodeFrame(buffer: ArrayBuffer, inputs: number, outputs: number): Frame {
  const view = new DataView(buffer);
  if (view.getUint8(0) !== FRAME) {
    throw new Error(`unknown kind of message ${view.getUint8(0)}`);
  }
  const frame: Frame = {
    posesPerCycle: view.getUint8(1),
    robots: view.getUint16(2, true),
    now: view.getUint32(4, true),
    first: view.getUint32(8, true),
    last: view.getUint32(12, true),
    rate: view.getFloat32(16, true),
    running: view.getUint8(20) === 1,
    from: view.getUint32(24, true),
    log: [],
    poses: new Map(),
  };
  const after = readLog(buffer, frame, view.getUint16(28, true), [inputs, frame.robots, outputs]);
  readPoses(buffer, frame, view.getUint16(30, true), after);
  return frame;
}

export function isFrameOf(buffer: ArrayBuffer, swarm: { number: number; robots: unknown[] }): boolean {
  const view = new DataView(buffer);
  return view.getUint8(21) === (swarm.number & 255) && view.getUint16(2, true) === swarm.robots.length;
}

function readLog(buffer: ArrayBuffer, frame: Frame, cycles: number, widths: [number, number, number]): number {
  let at = HEADER;
  const bits = (width: number): Uint8Array => {
    const unpacked = unpackBits(new Uint8Array(buffer, at, Math.ceil(width / 8)), width);
    at += Math.ceil(width / 8);
    return unpacked;
  };
  for (let cycle = 0; cycle < cycles; cycle++) {
    const [inputs, robots, outputs] = [bits(widths[0]), bits(widths[1]), bits(widths[2])];
    const size = 4 * frame.robots;
    // The packed bits leave the numbers unaligned, so they are copied.
    const places = new Float32Array(buffer.slice(at, at + size));
    at += size;
    const count = new DataView(buffer).getUint16(at, true);
    const numbers = new Uint16Array(buffer.slice(at + 2, at + 2 + 4 * count));
    at += 2 + 4 * count;
    const flip = (i: number): [number, number] => [numbers[2 * i] ?? 0, (numbers[2 * i + 1] ?? 0) / CYCLE_STEPS];
    const flips = Array.from({ length: count }, (_, i) => flip(i));
    frame.log.push({ inputs, robots, outputs, places, flips });
  }
  return at;
}

function readPoses(buffer: ArrayBuffer, frame: Frame, count: number, start: number): void {
  const view = new DataView(buffer);
  let at = start;
  for (let i = 0; i < count; i++) {
    const robot = view.getUint16(at, true);
    const points = view.getUint16(at + 2, true);
    const origin = view.getFloat32(at + 4, true);
    const size = frame.posesPerCycle * points * 4;
    const coordinates = new Int16Array(buffer.slice(at + 8, at + 8 + size));
    frame.poses.set(robot, { points, origin, coordinates });
    at += 8 + size;
  }
}

/** The lowest `width` bits, from the lowest bit of the first byte. */
export function unpackBits(bytes: Uint8Array, width: number): Uint8Array {
  return Uint8Array.from({ length: width }, (_, i) => ((bytes[i >> 3] ?? 0) >> (i & 7)) & 1);
}
