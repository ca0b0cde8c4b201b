// The threads of a wave machine: which of its waves a robot carries in a cycle.

import type { ShownWaves } from "../protocol";

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

/** The number of a thread's color, from 1. */
export function threadColor(thread: number): number {
  return (thread % THREAD_COLORS) + 1;
}
