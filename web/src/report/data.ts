// Reads what the pages of results contain.

import type { RecordedBody, RecordedSwarm } from "../protocol";
import { decodeNumbers, type Gait } from "../robots/gait";

/** How a recorded body walks, with so many frames a cycle. */
export function gaitOf({ corners: points, frames }: RecordedBody, posesPerCycle: number): Gait {
  const coordinates = decodeNumbers(frames);
  const cycles = (coordinates.length / points / 2 - 1) / posesPerCycle;
  return { posesPerCycle, cycles, points, origin: 0, coordinates };
}

/** Whether a robot has become unstable by a time in cycles. A cycle that the fault ended was not recorded whole. */
export function isUnstable(
  fault: number | null,
  time: number,
  { pace, cycles }: Pick<RecordedSwarm, "pace" | "cycles">,
): boolean {
  return fault !== null && time * pace >= Math.min(fault, cycles * pace);
}
