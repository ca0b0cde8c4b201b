// Time for small animations, while there are any.

import { prefersStillness } from "../theme";

type Tick = (seconds: number) => void;

export class Ticker {
  readonly #ticks = new Set<Tick>();
  #asked = false;
  #on = false;
  #before = 0;

  /** Animations stop while their tab is not shown. */
  turn(on: boolean): void {
    this.#on = on;
    this.#wake();
  }

  add(tick: Tick): () => void {
    this.#ticks.add(tick);
    this.#wake();
    return () => this.#ticks.delete(tick);
  }

  #wake(): void {
    if (this.#on && !this.#asked && this.#ticks.size > 0) {
      this.#asked = true;
      requestAnimationFrame(time => this.#frame(time));
    }
  }

  #frame(time: number): void {
    this.#asked = false;
    const seconds = Math.min(0.1, Math.max(0, (time - this.#before) / 1000));
    this.#before = time;
    // Someone who asked for stillness still sees each pattern, as a picture that changes a few times a minute.
    for (const tick of [...this.#ticks]) {
      tick(prefersStillness() ? 0 : seconds);
    }
    this.#wake();
  }
}
