// Time for small animations, while there are any.

import { FrameLoop } from "../frame_loop";
import { prefersStillness } from "../theme";

type Tick = (seconds: number) => void;

export class Ticker {
  readonly #ticks = new Set<Tick>();
  readonly #loop = new FrameLoop(seconds => this.#pass(seconds));
  #on = false;

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
    if (this.#moves) {
      this.#loop.wake();
    }
  }

  get #moves(): boolean {
    return this.#on && this.#ticks.size > 0;
  }

  #pass(seconds: number): boolean {
    // Someone who asked for stillness still sees each pattern, as a picture that changes a few times a minute.
    for (const tick of [...this.#ticks]) {
      tick(prefersStillness() ? 0 : seconds);
    }
    return this.#moves;
  }
}
