// Play, pause, scrub and speed: the time in cycles of everything that is shown in step.

import { FrameLoop } from "../frame_loop";
import { part } from "./shown";

export class Clock {
  time = 0;
  playing = false;
  readonly #loop = new FrameLoop(seconds => this.#pass(seconds));
  readonly #play: HTMLElement;
  readonly #scrub: HTMLInputElement;
  readonly #speed: HTMLSelectElement;
  readonly #text: HTMLElement;

  /** `draw` shows a moment of so many cycles; the buttons are in `root`. */
  constructor(
    root: Element,
    readonly cycles: number,
    private readonly draw: () => void,
  ) {
    this.#play = part(root, ".play");
    this.#scrub = part(root, ".scrub");
    this.#speed = part(root, ".speed");
    this.#text = part(root, ".clock");
    this.#play.addEventListener("click", () => (this.playing ? this.#pause() : this.play()));
    this.#scrub.max = String(cycles);
    this.#scrub.addEventListener("input", () => this.seek(Number(this.#scrub.value)));
    this.#show();
  }

  /** Draws at the next screen frame. */
  wake(): void {
    this.#loop.wake();
  }

  /** Plays from here, or from the start after the end. */
  play(): void {
    this.playing = true;
    this.seek(this.time < this.cycles ? this.time : 0);
  }

  #pause(): void {
    this.playing = false;
    this.#show();
  }

  seek(cycle: number): void {
    this.time = Math.max(0, Math.min(this.cycles, cycle));
    this.#show();
    this.wake();
  }

  /** The number of the cycle under way, from 0. */
  get cycle(): number {
    return Math.min(Math.floor(this.time), this.cycles - 1);
  }

  #pass(seconds: number): boolean {
    if (this.playing) {
      this.time = Math.min(this.cycles, this.time + seconds * Number(this.#speed.value));
      this.playing = this.time < this.cycles;
      this.#show();
    }
    this.draw();
    return this.playing;
  }

  #show(): void {
    this.#play.textContent = this.playing ? "Pause" : "Play";
    this.#scrub.value = String(this.time);
    this.#text.textContent = this.cycles > 0 ? `cycle ${this.cycle + 1} of ${this.cycles}` : "no whole cycle";
  }
}
