"use strict";
// Play, pause, scrub and speed: the time in cycles of everything that is shown in step.

class Clock {
  constructor(root, cycles, draw) {
    this.cycles = cycles;
    this.draw = draw;
    this.time = 0;
    this.playing = false;
    for (const name of ["play", "scrub", "speed", "clock"]) this[name + "Part"] = root.querySelector("." + name);
    this.playPart.onclick = () => this.toggle();
    this.scrubPart.max = cycles;
    this.scrubPart.oninput = () => this.seek(Number(this.scrubPart.value));
    this.show();
  }

  toggle() {
    this.playing = !this.playing;
    if (this.playing && this.time >= this.cycles) this.time = 0;
    this.last = undefined;
    if (this.playing) requestAnimationFrame(now => this.tick(now));
    this.show();
  }

  tick(now) {
    if (!this.playing) return;
    if (this.last !== undefined) this.time += (now - this.last) / 1000 * Number(this.speedPart.value);
    this.last = now;
    if (this.time >= this.cycles) {
      this.time = this.cycles;
      this.playing = false;
    } else {
      requestAnimationFrame(next => this.tick(next));
    }
    this.show();
    this.draw();
  }

  seek(cycle) {
    this.time = Math.max(0, Math.min(this.cycles, cycle));
    this.show();
    this.draw();
  }

  /** The number of the cycle under way, from 0. */
  cycle() {
    return Math.min(Math.floor(this.time), this.cycles - 1);
  }

  show() {
    this.playPart.textContent = this.playing ? "Pause" : "Play";
    this.scrubPart.value = this.time;
    this.clockPart.textContent = "cycle " + (this.cycle() + 1) + " of " + this.cycles;
  }
}
