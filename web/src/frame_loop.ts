// Screen frames, one after the other while something moves, and none while nothing does.

/** Longer pauses, as of a hidden tab, do not count as time. */
const LONGEST_STEP = 0.1;

export class FrameLoop {
  #asked = 0;
  #before = 0;

  /** `pass` lets some seconds pass and draws; whether something still moves. */
  constructor(private readonly pass: (seconds: number) => boolean) {}

  wake(): void {
    if (this.#asked === 0) {
      this.#asked = requestAnimationFrame(time => this.#frame(time));
    }
  }

  #frame(time: number): void {
    this.#asked = 0;
    const seconds = Math.min(LONGEST_STEP, Math.max(0, (time - this.#before) / 1000));
    this.#before = time;
    if (this.pass(seconds)) {
      this.wake();
    }
  }
}
