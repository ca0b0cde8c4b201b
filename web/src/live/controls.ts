// Play, pause, step, reset, the speed, and the slider that rewinds.

import { counted } from "../counted";
import { button, changeIcon, element, iconButton } from "../element";
import type { View } from "./animation";
import { RunUntil } from "./until";
import { REAL_TIME, type LiveSwarm } from "./swarm";

/** Speeds as multiples of real time; null is as fast as possible. */
export const SPEEDS: [string, number | null][] = [
  ["¼×", 0.25],
  ["1×", 1],
  ["2×", 2],
  ["4×", 4],
  ["16×", 16],
  ["max", null],
];

const CROWD = 24;

const MOST_CYCLES = 1000;

export class Controls implements View {
  readonly host = element("div", { class: "controls", role: "group", "aria-label": "Run" });
  readonly #play = iconButton("play", "Play", () => this.toggle(), { class: "icon primary", "data-do": "play" });
  readonly #waveStep = button("One step", () => this.swarm.step(this.#cycles), { "data-do": "wave-step" });
  readonly #crowd = iconButton("crowd", "All robots at once", () => this.#gather(), { "data-do": "crowd" });
  #cycles = 1;
  readonly #slider = element("input", {
    type: "range",
    min: 0,
    max: 0,
    value: 0,
    class: "rewind",
    "aria-label": "Rewind to a cycle",
    title: "Rewind",
    oninput: () => this.#rewind(),
  });
  readonly #cycle = element("output", { class: "cycle", title: "The cycle that is shown, and the last one" });
  readonly #rate = element("output", { class: "rate", title: "Cycles simulated in a second" });
  #asked: number | null = null;

  constructor(
    private readonly swarm: LiveSwarm,
    large: HTMLElement,
  ) {
    this.host.append(
      iconButton("reset", "Back to the start", () => swarm.reset(), { "data-do": "reset" }),
      this.#play,
      iconButton("step", "One cycle (.)", () => swarm.step(), { "data-do": "step" }),
      this.#waveStep,
      this.#crowd,
      this.#speeds(),
      new RunUntil(swarm).host,
      this.#slider,
      this.#cycle,
      this.#rate,
      large,
    );
    swarm.running.follow(running => {
      changeIcon(this.#play, running ? "pause" : "play", running ? "Pause (Space)" : "Play (Space)");
      this.#play.dataset["running"] = String(running);
    });
    swarm.selection.together.follow(together => this.#crowd.setAttribute("aria-pressed", String(together)));
    swarm.definition.follow(definition => {
      this.#crowd.hidden = (definition?.robots.length ?? 0) <= CROWD;
      if (this.#crowd.hidden) {
        swarm.selection.together.set(false);
      }
      const step = definition?.waves?.step ?? 0;
      this.#cycles = step;
      this.#waveStep.hidden = step === 0 || step > MOST_CYCLES;
      this.#waveStep.title = `A step has ${counted(step, "cycle")}`;
    });
    swarm.frame.on(() => this.draw());
  }

  toggle(): void {
    if (this.swarm.running.value) {
      this.swarm.pause();
    } else {
      this.swarm.play();
    }
  }

  draw(): void {
    const frame = this.swarm.frame.value;
    if (frame === null) {
      this.#cycle.textContent = this.#rate.textContent = "";
      return;
    }
    // Frames of before the rewind do not move the slider back.
    if (this.#asked === frame.now || this.swarm.running.value) {
      this.#asked = null;
    }
    this.#slider.min = String(frame.first);
    this.#slider.max = String(frame.last);
    if (this.#asked === null) {
      this.#slider.value = String(frame.now);
    }
    this.#cycle.textContent = frame.now === frame.last ? `cycle ${frame.now}` : `cycle ${frame.now} of ${frame.last}`;
    this.#rate.textContent = frame.running
      ? `${frame.rate < 10 ? frame.rate.toFixed(1) : Math.round(frame.rate)} cycles/s`
      : "";
  }

  #gather(): void {
    const { selection } = this.swarm;
    selection.followed.set(null);
    selection.together.set(!selection.together.value);
  }

  #rewind(): void {
    const cycle = Number(this.#slider.value);
    this.#asked = cycle;
    void this.swarm.seek(cycle).then(done => {
      if (!done && this.#asked === cycle) {
        this.#asked = null;
        this.draw();
      }
    });
  }

  #speeds(): HTMLElement {
    return element(
      "select",
      {
        class: "speed",
        "aria-label": "Speed relative to real time",
        title: "Speed; 1× is real time, four cycles a second",
        onchange: event => {
          const chosen = SPEEDS[(event.target as HTMLSelectElement).selectedIndex]?.[1] ?? null;
          this.swarm.setSpeed(chosen === null ? null : chosen * REAL_TIME);
        },
      },
      ...SPEEDS.map(([label, factor]) => element("option", { value: label, selected: factor === 1 }, label)),
    );
  }
}
