// The threads of a wave machine: which of its waves a robot carries in a cycle.

import type { StimulusSource, ShownWaves, WaveBit, WaveRegister } from "../protocol";

/** Threads have so many colors; more repeat them. */
export const THREAD_COLORS = 8;

/**
 * The thread, from 0, whose wave a robot carries in a cycle; cycles count from 1, and at the start, 0, there is none.
 */
export function threadAt(waves: ShownWaves, robot: number, cycle: number): number | null {
  const phase = waves.phases[robot];
  if (phase === undefined || cycle < 1) {
    return null;
  }
  const beats = Math.floor((cycle - 1) / waves.beat) - waves.begins / waves.beat;
  return (((beats - phase) % waves.threads) + waves.threads) % waves.threads;
}

export function threadColor(thread: number): number {
  return (thread % THREAD_COLORS) + 1;
}

/**
 * The bits of a register of a thread after the last step that is seen whole by a cycle, by the `value` of a source in a
 * cycle; null before the first, and if a cycle is no longer known.
 */
export function registerAt(
  waves: ShownWaves,
  { bits }: WaveRegister,
  { thread, cycle }: { thread: number; cycle: number },
  value: (source: StimulusSource, cycle: number) => number | null,
): number[] | null {
  // Cycles count from 1 here, and those of the machine from 0.
  const begins = ({ after }: WaveBit): number => waves.begins + thread * waves.beat + after + 1;
  const lastSeen = (bit: WaveBit): number =>
    Math.max(bit.starts.length - 1, Math.floor((cycle - begins(bit)) / waves.step));
  const step = Math.min(...bits.map(lastSeen));
  const values = bits.map(bit => {
    const start = bit.starts[step];
    return start === undefined ? value(bit.source, begins(bit) + step * waves.step) : Number(start);
  });
  return step < 0 || values.includes(null) ? null : (values as number[]);
}
