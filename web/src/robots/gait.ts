// How a body walks under one pattern: its poses at any moment.

import type { Outline } from "../live/playback";
import type { EncodedGait } from "../protocol";

export interface Gait {
  posesPerCycle: number;
  cycles: number;
  points: number;
  /** Hundredths of a voxel: the pose at the start, then those of all cycles. */
  coordinates: Int16Array;
}

export function decodeGait(encoded: EncodedGait): Gait {
  const raw = atob(encoded.poses);
  const bytes = Uint8Array.from(raw, letter => letter.charCodeAt(0));
  const view = new DataView(bytes.buffer);
  const coordinates = Int16Array.from({ length: bytes.length >> 1 }, (_, i) => view.getInt16(2 * i, true));
  const poses = encoded.frames * encoded.cycles + 1;
  return { posesPerCycle: encoded.frames, cycles: encoded.cycles, points: coordinates.length / poses / 2, coordinates };
}

/** The outline at a moment in cycles; before the start and after the end it stands still. */
export function outlineAt(gait: Gait, time: number): Outline {
  const size = 2 * gait.points;
  const last = gait.posesPerCycle * gait.cycles;
  const place = Math.min(last, Math.max(0, time * gait.posesPerCycle));
  const [before, after] = [Math.floor(place), Math.min(last, Math.floor(place) + 1)];
  const part = place - before;
  return Float32Array.from({ length: size }, (_, i) => {
    const [from, to] = [gait.coordinates[before * size + i] ?? 0, gait.coordinates[after * size + i] ?? 0];
    return (from + (to - from) * part) / 100;
  });
}
