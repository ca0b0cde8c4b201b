// The stretch of time that the waveforms and the spacetime diagram both show.

import { Observable } from "../observable";

/** Where the present stands in a view that follows it. */
const PRESENT = 0.86;
const ZOOMS = [3, 5, 8, 12, 18, 28, 44];

export class Timeline {
  readonly zoom = new Observable(18);
  /** The cycle at the left edge while it does not follow the present. */
  readonly held = new Observable<number | null>(null);
  readonly label = 96;

  zoomBy(steps: number): void {
    const index = ZOOMS.indexOf(this.zoom.value) + steps;
    this.zoom.set(ZOOMS[Math.min(ZOOMS.length - 1, Math.max(0, index))] as number);
  }

  /** The cycle at the left edge of a diagram that is `width` pixels wide. */
  start(width: number, now: number): number {
    return this.held.value ?? Math.max(0, now - (PRESENT * width) / this.zoom.value);
  }

  /** Moves by some pixels. Beyond the present it follows it again. */
  drag(pixels: number, width: number, now: number, first: number): void {
    const start = this.start(width, now) - pixels / this.zoom.value;
    const following = Math.max(0, now - (PRESENT * width) / this.zoom.value);
    this.held.set(start >= following ? null : Math.max(first, start));
  }
}
