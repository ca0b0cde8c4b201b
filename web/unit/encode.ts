// Writes frames as the server does, for tests.

interface Written {
  now: number;
  first: number;
  last: number;
  rate: number;
  running: boolean;
  number: number;
  from: number;
  robots: number;
  log: { inputs: number[]; robots: number[]; outputs: number[]; places: number[]; flips?: [number, number][] }[];
  poses: { robot: number; origin: number; frames: number[][] }[];
}

export function encodeFrame(given: Partial<Written>): ArrayBuffer {
  const frame: Written = {
    now: 0,
    first: 0,
    last: given.now ?? 0,
    rate: 4,
    running: false,
    number: 1,
    from: 1,
    log: [],
    poses: [],
    robots: given.log?.[0]?.robots.length ?? 0,
    ...given,
  };
  const bytes: number[] = [];
  const add = (size: number, write: (view: DataView) => void): void => {
    const view = new DataView(new ArrayBuffer(size));
    write(view);
    bytes.push(...new Uint8Array(view.buffer));
  };
  const u8 = (value: number): void => add(1, view => view.setUint8(0, value));
  const u16 = (value: number): void => add(2, view => view.setUint16(0, value, true));
  const i16 = (value: number): void => add(2, view => view.setInt16(0, value, true));
  const u32 = (value: number): void => add(4, view => view.setUint32(0, value, true));
  const f32 = (value: number): void => add(4, view => view.setFloat32(0, value, true));
  u8(1);
  u8(frame.poses[0]?.frames.length ?? 1);
  u16(frame.robots);
  [frame.now, frame.first, frame.last].forEach(u32);
  f32(frame.rate);
  u8(frame.running ? 1 : 0);
  u8(frame.number & 255);
  u16(0);
  u32(frame.from);
  u16(frame.log.length);
  u16(frame.poses.length);
  for (const { inputs, robots, outputs, places, flips = [] } of frame.log) {
    [inputs, robots, outputs].forEach(bits => packed(bits).forEach(u8));
    places.forEach(f32);
    u16(flips.length);
    flips.flat().forEach(u16);
  }
  for (const { robot, origin, frames } of frame.poses) {
    u16(robot);
    u16((frames[0]?.length ?? 0) / 2);
    f32(origin);
    frames.flat().forEach(i16);
  }
  return new Uint8Array(bytes).buffer;
}

function packed(bits: number[]): number[] {
  return Array.from({ length: Math.ceil(bits.length / 8) }, (_, i) =>
    bits.slice(8 * i, 8 * i + 8).reduce((sum, bit, place) => sum + (bit << place), 0),
  );
}
