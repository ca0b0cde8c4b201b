// Draws the views of a swarm once a screen frame while something moves, and not at all while nothing does.

import { FrameLoop } from "../frame_loop";
import { prefersStillness } from "../theme";
import type { LiveSwarm } from "./swarm";

export interface View {
  draw(): void;
  /** Whether a slow machine may draw it less often than the robots. */
  readonly patient?: boolean;
}

/** A screen frame that takes longer, in seconds, is that of a slow machine. */
const SLOW = 0.024;
/** There patient views are drawn once in so many frames. */
const SHARE = 3;

export class Animation {
  readonly #views: View[] = [];
  readonly #loop = new FrameLoop(seconds => this.#pass(seconds));
  #usual = 1 / 60;
  #count = 0;

  constructor(private readonly swarm: LiveSwarm) {
    swarm.frame.on(() => this.wake());
    document.addEventListener("visibilitychange", () => this.wake());
  }

  add(view: View): void {
    this.#views.push(view);
    this.wake();
  }

  wake(): void {
    this.#loop.wake();
  }

  #pass(seconds: number): boolean {
    const { playback } = this.swarm;
    if (prefersStillness()) {
      playback.finish();
    } else {
      playback.advance(seconds);
    }
    this.#draw(seconds, !playback.moving);
    return playback.moving;
  }

  #draw(seconds: number, last: boolean): void {
    this.#usual += 0.1 * (seconds - this.#usual);
    this.#count++;
    const all = last || this.#usual < SLOW || this.#count % SHARE === 0;
    for (const view of this.#views) {
      if (all || !view.patient) {
        view.draw();
      }
    }
  }
}
