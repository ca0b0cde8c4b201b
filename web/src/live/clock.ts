// The clock of a circuit, by hand or by itself.

import { button, countIn, element, fill } from "../element";
import { bitsOf, type PortBit } from "../ports";
import { closeOutside } from "../menu";
import type { ShownSwarm } from "../protocol";
import type { LiveSwarm } from "./swarm";

export class ClockPanel {
  readonly host = element("div", { class: "clock", role: "group", "aria-label": "Clock" });
  #endPulse: () => void = () => {};
  #unfollow: () => void = () => {};
  #name: HTMLElement | null = null;

  constructor(private readonly swarm: LiveSwarm) {
    swarm.definition.on(() => this.#build());
    swarm.clock.on(() => this.#showName());
  }

  #build(): void {
    const definition = this.swarm.definition.value;
    const bits = definition === null ? [] : likelyClock(definition);
    const [likely] = bits;
    this.#endPulse();
    this.host.hidden = likely === undefined;
    if (definition === null || likely === undefined) {
      return;
    }
    const which = element(
      "select",
      {
        "aria-label": "The input that is the clock",
        onchange: () => {
          half.value = String(halfOf(definition, Number(which.value)));
          this.#apply(which, half, this.swarm.clock.value !== null);
        },
      },
      ...bits.map(bit => element("option", { value: bit.index }, bit.name)),
    );
    const half = element("input", {
      type: "number",
      min: 1,
      max: 999,
      value: halfOf(definition, likely.index),
      "aria-label": "Cycles between two changes of the clock",
      onchange: () => this.#apply(which, half, this.swarm.clock.value !== null),
    });
    const automatic = element("button", {
      type: "button",
      class: "toggle",
      "data-do": "clock",
      title: "Let this input change by itself",
      onclick: () => this.#apply(which, half, this.swarm.clock.value === null),
    });
    this.#unfollow();
    this.#unfollow = this.swarm.clock.follow(clock => {
      automatic.textContent = clock === null ? "Start clock" : "Stop clock";
      automatic.setAttribute("aria-pressed", String(clock !== null));
    });
    const press = (): void => {
      this.#endPulse();
      this.#endPulse = pulse(this.swarm, Number(which.value), countIn(half));
    };
    const once = button("Pulse", press, {
      title: "Set the input to 1 for half a period, then to 0",
      "data-do": "pulse",
    });
    const parts = [which, once, automatic, element("label", { class: "half" }, "every ", half, " cycles")];
    if (isClock(likely)) {
      fill(this.host, element("span", { class: "caption" }, "Clock"), ...parts);
      return;
    }
    const name = element("summary");
    this.#name = name;
    this.#showName();
    const menu = element("details", { class: "menu" }, name, element("div", { class: "sheet row" }, ...parts));
    closeOutside(menu);
    fill(this.host, menu);
  }

  /** The menu says what it does while it is closed. */
  #showName(): void {
    const clock = this.swarm.clock.value;
    if (this.#name !== null) {
      this.#name.textContent =
        clock === null ? "Clock" : `Clock: ${this.swarm.nameOf({ input: clock.bit })} every ${clock.half}`;
    }
  }

  #apply(which: HTMLSelectElement, half: HTMLInputElement, on: boolean): void {
    const isNew = on && this.swarm.clock.value === null;
    this.swarm.setClock(on ? { bit: Number(which.value), half: countIn(half) } : null);
    if (isNew && !this.swarm.running.value) {
      this.swarm.play();
    }
  }
}

/** Raises an input, and lowers it when it has been 1 for so many cycles. Returns what ends this early. */
export function pulse(swarm: LiveSwarm, bit: number, cycles: number): () => void {
  const begun = swarm.frame.value?.now ?? 0;
  // The last cycle in which it was 0: the swarm may be ahead of the frame that is shown.
  let before = begun;
  swarm.setClock(null);
  swarm.setBit(bit, 1);
  if (!swarm.running.value) {
    swarm.step(cycles);
  }
  const stop = swarm.frame.on(frame => {
    const now = frame?.now ?? begun;
    while (before < now && swarm.log.at(before + 1)?.inputs[bit] !== 1) {
      before++;
    }
    if (now >= before + cycles || now < begun) {
      stop();
      swarm.setBit(bit, 0);
      if (frame?.running === false) {
        swarm.step(cycles);
      }
    }
  });
  return stop;
}

/** The inputs that may be the clock, the likely one first; none of a wave machine, whose steps are its clock. */
export function likelyClock({ inputs, waves }: ShownSwarm): PortBit[] {
  const bits = (waves?.clock ?? null) === null ? bitsOf(inputs).filter(bit => bit.port.width === 1) : [];
  return [...bits.filter(isClock), ...bits.filter(bit => !isClock(bit))];
}

function isClock({ name }: PortBit): boolean {
  return /^(clk|clock|ck|cp)$/i.test(name);
}

/** The fewest cycles for which an input may have a value: as a clock, or else until every change has settled. */
export function halfOf({ clocks, hold }: Pick<ShownSwarm, "clocks" | "hold">, bit: number): number {
  return Math.max(2, clocks.find(clock => clock.bit === bit)?.half ?? hold);
}
