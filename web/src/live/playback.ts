// Turns frames, which arrive once a cycle, into poses for any moment between them.

import type { Frame, Poses } from "../frame";

/** The x and y of a robot's points, in voxels from its start. */
export type Outline = Float32Array;

/** How far behind the newest cycle the shown moment stays while the swarm runs, in cycles. */
const DELAY = 0.75;
/** Further behind than this, the shown moment jumps. */
const FARTHEST = 3;
/** Faster than this, single poses cannot be seen, and the newest is shown at once. */
const FASTEST = 40;
const STEP_RATE = 4;

export class Playback {
  /** The shown moment in cycles: the poses of cycle `c` are shown from `c - 1` to `c`. */
  time = 0;
  #now = 0;
  #rate = STEP_RATE;
  #running = false;
  #posesPerCycle = 1;
  #cycles = new Map<number, Map<number, Poses>>();

  get cycle(): number {
    return Math.ceil(this.time - 1e-9);
  }

  get moving(): boolean {
    return this.time < this.#now;
  }

  clear(): void {
    this.time = 0;
    this.#now = 0;
    this.#running = false;
    this.#cycles.clear();
  }

  push(frame: Frame): void {
    const jump = frame.now < this.#now || frame.now - this.time > FARTHEST;
    this.#posesPerCycle = frame.posesPerCycle;
    this.#now = frame.now;
    this.#running = frame.running;
    this.#rate = frame.running ? Math.max(0.1, frame.rate) : STEP_RATE;
    if (jump) {
      this.#cycles.clear();
      this.time = frame.now;
    }
    this.#keep(frame);
  }

  /** Lets `seconds` pass; whether something moved. */
  advance(seconds: number): boolean {
    if (!this.moving) {
      return false;
    }
    const behind = this.#now - this.time;
    const pace = this.#running ? Math.min(2, Math.max(0.5, 1 + 0.3 * (behind - DELAY))) : 1;
    const rate = Math.max(0, this.#rate * pace);
    this.time = rate > FASTEST ? this.#now : Math.min(this.#now, this.time + seconds * rate);
    return true;
  }

  finish(): void {
    this.time = this.#now;
  }

  /** The outline of a robot at the shown moment, if its poses are known. */
  outline(robot: number): Outline | null {
    const cycle = Math.max(this.cycle, 0);
    const poses = this.#cycles.get(cycle)?.get(robot);
    if (poses === undefined) {
      const newest = this.#newest(robot);
      return newest === null ? null : interpolate(newest, this.#posesPerCycle - 1, newest, this.#posesPerCycle - 1, 0);
    }
    // Pose `i` of `n` is that at `(i + 1) / n` of the cycle; before the first comes the last of the cycle before.
    const place = Math.max(0, 1 - (cycle - this.time)) * this.#posesPerCycle - 1;
    const index = Math.floor(place);
    const after = Math.min(index + 1, this.#posesPerCycle - 1);
    if (index >= 0) {
      return interpolate(poses, index, poses, after, place - index);
    }
    const before = this.#cycles.get(cycle - 1)?.get(robot) ?? poses;
    const last = before === poses ? 0 : this.#posesPerCycle - 1;
    return interpolate(before, last, poses, 0, place - index);
  }

  #keep(frame: Frame): void {
    const known = this.#cycles.get(frame.now);
    if (known === undefined) {
      this.#cycles.set(frame.now, frame.poses);
    } else {
      frame.poses.forEach((poses, robot) => known.set(robot, poses));
    }
    for (const cycle of this.#cycles.keys()) {
      if (cycle < this.cycle - 1) {
        this.#cycles.delete(cycle);
      }
    }
  }

  #newest(robot: number): Poses | null {
    return (
      [...this.#cycles.values()]
        .reverse()
        .find(poses => poses.has(robot))
        ?.get(robot) ?? null
    );
  }
}

/** The outline `part` of the way from frame `i` of `a` to frame `j` of `b`. */
export function interpolate(a: Poses, i: number, b: Poses, j: number, part: number): Outline {
  const size = 2 * b.points;
  const outline = new Float32Array(size);
  for (let k = 0; k < size; k++) {
    const from = (a.coordinates[i * size + k] ?? 0) / 100 + (k % 2 === 0 ? a.origin : 0);
    const to = (b.coordinates[j * size + k] ?? 0) / 100 + (k % 2 === 0 ? b.origin : 0);
    outline[k] = from + (to - from) * part;
  }
  return outline;
}
