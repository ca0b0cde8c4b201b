// The cycles of a run that can be rewound to.

import type { Frame, LoggedCycle } from "./frame";

/** Cycles `first + 1` to `last`; cycle 0 is the start, of which nothing is logged. */
export class RunLog {
  first = 0;
  last = 0;
  #base = 1;
  #cycles: (LoggedCycle | undefined)[] = [];

  /** Takes the cycles of a frame. They replace all that was known from the first of them on. */
  merge(frame: Frame): void {
    this.#cycles.length = Math.max(0, Math.min(this.#cycles.length, frame.from - this.#base));
    if (this.#cycles.length === 0) {
      this.#base = frame.from;
    }
    frame.log.forEach((cycle, i) => this.#put(frame.from + i, cycle));
    this.first = frame.first;
    this.last = frame.last;
    this.#trim();
  }

  clear(): void {
    this.first = 0;
    this.last = 0;
    this.#base = 1;
    this.#cycles = [];
  }

  /** A cycle, from 1; nothing if the page has not been sent it. */
  at(cycle: number): LoggedCycle | undefined {
    return this.#cycles[cycle - this.#base];
  }

  #put(number: number, cycle: LoggedCycle): void {
    this.#cycles[number - this.#base] = cycle;
  }

  #trim(): void {
    this.#cycles.length = Math.max(0, Math.min(this.#cycles.length, this.last - this.#base + 1));
    const gone = this.first + 1 - this.#base;
    // Shifting the array each cycle would be slow, so cycles are dropped in blocks.
    if (gone > 256) {
      this.#cycles.splice(0, gone);
      this.#base += gone;
    }
  }
}
