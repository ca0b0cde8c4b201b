// What is pointed at and what is followed, the same in all views of a swarm.

import { Observable } from "./observable";
import type { StimulusSource } from "./protocol";

export class Selection {
  readonly pointed = new Observable<StimulusSource | null>(null);
  readonly followed = new Observable<number | null>(null);
  /** The robots of the part of the circuit that is open; null are all. */
  readonly opened = new Observable<number[] | null>(null);

  /** Whether the stage shows all robots at once, however small. */
  readonly together = new Observable(false);

  point(source: StimulusSource | null): void {
    if (!sameSource(source, this.pointed.value)) {
      this.pointed.set(source);
    }
  }

  /** Follows a robot alone, or all again when it is followed already. */
  follow(robot: number | null): void {
    this.followed.set(this.followed.value === robot ? null : robot);
  }

  clear(): void {
    this.pointed.set(null);
    this.followed.set(null);
    this.opened.set(null);
  }
}

export function sameSource(a: StimulusSource | null, b: StimulusSource | null): boolean {
  return a === b || JSON.stringify(a) === JSON.stringify(b);
}
