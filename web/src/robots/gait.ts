// How a body walks under one pattern: its poses at any moment.

import type { Poses } from "../frame";
import { interpolate, type Outline } from "../live/playback";
import type { EncodedGait } from "../protocol";

/** The pose at the start, then those of all cycles. */
export interface Gait extends Poses {
  posesPerCycle: number;
  cycles: number;
}

/** Numbers of 16 bits, lower byte first, from their base64. */
export function decodeNumbers(text: string): Int16Array {
  const view = new DataView(Uint8Array.from(atob(text), letter => letter.charCodeAt(0)).buffer);
  return Int16Array.from({ length: view.byteLength >> 1 }, (_, i) => view.getInt16(2 * i, true));
}

export function decodeGait({ frames, cycles, poses }: EncodedGait): Gait {
  const coordinates = decodeNumbers(poses);
  const points = coordinates.length / (frames * cycles + 1) / 2;
  return { posesPerCycle: frames, cycles, points, origin: 0, coordinates };
}

/** The outline at a moment in cycles; before the start and after the end it stands still. */
export function outlineAt(gait: Gait, time: number): Outline {
  const last = gait.posesPerCycle * gait.cycles;
  const place = Math.min(last, Math.max(0, time * gait.posesPerCycle));
  const before = Math.floor(place);
  return interpolate(gait, before, gait, Math.min(last, before + 1), place - before);
}
