// Where the robots of an exported page are, and the poses of a cycle. A robot walks with the stride of the pattern that
// it has answered to; when that changes, it passes from one shape to the other within the cycle.

import type { Poses } from "../frame";
import type { Machine } from "./machine";

/** No pattern. */
const NONE = 255;

/** The places and strides of all robots after a cycle. */
export interface WalkState {
  /** Voxels from the start. */
  places: Float32Array;
  /** The patterns of the strides in the last cycle and in the one before. */
  strides: Uint8Array;
  before: Uint8Array;
}

export class Walkers {
  state: WalkState;

  constructor(private readonly machine: Machine) {
    const count = machine.strides.length;
    const first = Uint8Array.from({ length: count }, (_, robot) => machine.firstPattern(robot));
    this.state = { places: new Float32Array(count), strides: first, before: first };
  }

  /** One cycle in which the robots have answered to these patterns. */
  step(answered: Uint8Array): void {
    const { places, strides: before } = this.state;
    const strides = answered.map((pattern, robot) => (pattern === NONE ? (before[robot] ?? 0) : pattern));
    const shift = (robot: number): number => this.machine.strides[robot]?.[strides[robot] ?? 0]?.shift ?? 0;
    this.state = { places: places.map((place, robot) => place + shift(robot)), strides, before };
  }

  /** The poses of a robot in the last cycle; before the first one it stands still. */
  poses(robot: number, cycle: number): Poses {
    const { places, strides, before } = this.state;
    const [now, old] = [strides, before].map(of => this.machine.strides[robot]?.[of[robot] ?? 0]);
    const points = this.machine.swarm.robots[robot]?.points ?? 0;
    const frames = this.machine.swarm.frames;
    const coordinates = new Int16Array(2 * points * frames);
    if (now === undefined || old === undefined) {
      return { points, origin: 0, coordinates };
    }
    const shift = cycle === 0 ? 0 : now.shift;
    for (let frame = 0; frame < frames; frame++) {
      const part = (frame + 1) / frames;
      // The same pose all the time at the start.
      const from = 2 * points * (cycle === 0 ? frames - 1 : frame);
      for (let k = 0; k < 2 * points; k++) {
        const [a, b] = [old.poses[from + k] ?? 0, now.poses[from + k] ?? 0];
        const moved = k % 2 === 0 ? shift * part : 0;
        coordinates[frame * 2 * points + k] = Math.round(100 * (a + (b - a) * part + moved));
      }
    }
    return { points, origin: (places[robot] ?? 0) - shift, coordinates };
  }
}
