// The inputs: a switch for each bit, a number with steps for each bus, a picture for a bus that may be one.

import { element, fill, iconButton } from "../element";
import { bitsOf, offsetOf, toBits, toNumber, type PortBit } from "../ports";
import type { Column } from "../protocol";
import type { View } from "./animation";
import { numberFormat, numberText, typedNumber } from "./numbers";
import { pictureInput, pictureSide } from "./picture_input";
import type { LiveSwarm } from "./swarm";

/** Buses up to this width have a switch for each bit, too. */
const SWITCHED = 8;

export class InputPanel implements View {
  readonly host = element("div", { class: "inputs", role: "group", "aria-label": "Inputs" });
  // These are called at every drawing, so they touch the page only after a change.
  readonly #updates: (() => void)[] = [];
  readonly #marks: (() => void)[] = [];

  constructor(private readonly swarm: LiveSwarm) {
    swarm.definition.on(() => this.#build());
    numberFormat.on(() => this.#build());
    swarm.inputs.on(() => this.draw());
    swarm.clock.on(() => this.#marks.forEach(mark => mark()));
  }

  draw(): void {
    for (const update of this.#updates) {
      update();
    }
  }

  #build(): void {
    const inputs = this.swarm.definition.value?.inputs ?? [];
    const bits = bitsOf(inputs);
    this.#updates.length = 0;
    this.#marks.length = 0;
    const caption = element("span", { class: "caption" });
    this.#updates.push(() => this.#name(caption, inputs.length));
    fill(
      this.host,
      caption,
      ...inputs.map(port =>
        this.#port(
          port,
          bits.filter(bit => bit.port === port),
        ),
      ),
    );
    this.draw();
  }

  #name(caption: HTMLElement, inputs: number): void {
    const isGiven = this.swarm.playback.cycle < this.swarm.scripted.value;
    const text = inputs === 0 ? "No inputs" : isGiven ? "Inputs, from the test" : "Inputs";
    if (caption.textContent !== text) {
      caption.textContent = text;
      caption.title = isGiven ? "Who sets an input takes over" : "";
    }
  }

  #port(port: Column, bits: PortBit[]): HTMLElement {
    const [first] = bits;
    if (first !== undefined && first.index === this.swarm.definition.value?.waves?.clock) {
      return waveClock(first);
    }
    if (port.members !== undefined && numberFormat.value === "names") {
      return this.#choice(port, port.members);
    }
    if (port.width === 1) {
      return this.#switch(bits[0] as PortBit, port.name);
    }
    if (pictureSide(port) > 0) {
      return element("div", { class: "bus" }, this.#number(port), this.#picture(port, bits));
    }
    const switches = port.width > SWITCHED ? [] : bits.map(bit => this.#switch(bit, String(bit.place), true));
    return element("div", { class: "bus" }, this.#number(port), element("div", { class: "bits" }, ...switches));
  }

  #picture(port: Column, bits: PortBit[]): HTMLElement {
    const shown = (index: number) => this.#shown(index);
    const { host, update } = pictureInput(port, bits, shown, (index, bit) => this.swarm.setBit(index, bit));
    this.#updates.push(update);
    return host;
  }

  #switch(bit: PortBit, label: string, small = false): HTMLElement {
    const { swarm } = this;
    const value = element("span", { class: "value" });
    const made = element(
      "button",
      {
        type: "button",
        role: "switch",
        class: small ? "switch small" : "switch",
        "aria-label": `input ${bit.name}`,
        "data-input": bit.name,
        title: `Input ${bit.name}`,
        onclick: () => swarm.setBit(bit.index, this.#shown(bit.index) === 1 ? 0 : 1),
        onmouseenter: () => swarm.selection.point({ input: bit.index }),
        onmouseleave: () => swarm.selection.point(null),
      },
      element("span", { class: "name" }, label),
      element("span", { class: "track", "aria-hidden": "true" }, element("span", { class: "knob" })),
      value,
    );
    let before: boolean | null = null;
    this.#updates.push(() => {
      const on = this.#shown(bit.index) === 1;
      if (on === before) {
        return;
      }
      before = on;
      made.setAttribute("aria-checked", String(on));
      value.textContent = on ? "1" : "0";
    });
    this.#marks.push(() => made.classList.toggle("clocked", swarm.clock.value?.bit === bit.index));
    return made;
  }

  /** The bit that is wanted, or what an automatic clock makes of it. */
  #shown(index: number): number {
    if (this.swarm.clock.value?.bit === index) {
      return this.swarm.value({ input: index }) ?? 0;
    }
    return Number(this.swarm.inputs.value[index] ?? 0);
  }

  /** The members of an enumeration, to pick one. A value that is none of them is shown as a number. */
  #choice(port: Column, members: [string, string][]): HTMLElement {
    const start = offsetOf(this.swarm.definition.value?.inputs ?? [], port);
    const other = element("option", { value: "", hidden: true });
    const field = element(
      "select",
      {
        "aria-label": `input ${port.name}`,
        "data-input": port.name,
        onchange: () => this.#set(port, start, BigInt(`0b${field.value}`)),
      },
      other,
      ...members.map(([name, digits]) => element("option", { value: digits }, name)),
    );
    let before: bigint | null = null;
    this.#updates.push(() => {
      const value = this.#current(port, start);
      if (value !== before) {
        before = value;
        const digits = toBits(value, port.width).join("");
        other.textContent = String(value);
        field.value = members.some(([, known]) => known === digits) ? digits : "";
      }
    });
    return element("label", { class: "number" }, element("span", { class: "name" }, port.name), field);
  }

  #number(port: Column): HTMLElement {
    const start = offsetOf(this.swarm.definition.value?.inputs ?? [], port);
    const field = element("input", {
      type: "text",
      inputmode: "numeric",
      autocomplete: "off",
      spellcheck: "false",
      "aria-label": `input ${port.name}`,
      "data-input": port.name,
      title: `A number of ${port.width} bits, such as 5, -3, 0x1f or 0b11`,
      onchange: () => this.#type(field, port, start),
      onkeydown: event => {
        const step = { ArrowUp: 1n, ArrowDown: -1n }[event.key];
        if (step !== undefined) {
          event.preventDefault();
          this.#add(port, start, step);
        }
      },
    });
    // As wide as its largest number, up to one of 64 bits.
    field.style.width = `calc(${Math.min(20, Math.max(5, Math.ceil(0.302 * port.width) + 1))}ch + 1.6em)`;
    this.#updates.push(() => {
      const text = numberText(this.#current(port, start), port);
      if (document.activeElement !== field && field.value !== text) {
        field.value = text;
      }
    });
    return element(
      "div",
      { class: "number" },
      element("span", { class: "name" }, port.name),
      iconButton("less", `Decrease ${port.name}`, () => this.#add(port, start, -1n)),
      field,
      iconButton("more", `Increase ${port.name}`, () => this.#add(port, start, 1n)),
    );
  }

  #current(port: Column, start: number): bigint {
    return toNumber([...this.swarm.inputs.value.slice(start, start + port.width)].map(Number));
  }

  #type(field: HTMLInputElement, port: Column, start: number): void {
    const value = typedNumber(field.value, port);
    field.setAttribute("aria-invalid", String(value === null));
    if (value !== null) {
      this.#set(port, start, value);
      field.value = numberText(value, port);
    }
  }

  /** Past the ends it goes round. */
  #add(port: Column, start: number, step: bigint): void {
    const size = 1n << BigInt(port.width);
    this.#set(port, start, (this.#current(port, start) + step + size) % size);
    const field = this.host.querySelector<HTMLInputElement>(`input[data-input="${port.name}"]`);
    if (field !== null) {
      field.value = numberText(this.#current(port, start), port);
    }
  }

  #set(port: Column, start: number, value: bigint): void {
    const bits = this.swarm.inputs.value;
    this.swarm.setInputs(bits.slice(0, start) + toBits(value, port.width).join("") + bits.slice(start + port.width));
  }
}

/** The clock of a wave machine, which no robot senses. */
function waveClock(bit: PortBit): HTMLElement {
  return element(
    "button",
    {
      type: "button",
      class: "switch",
      "aria-label": `clock ${bit.name}: each step is a clock edge`,
      "data-input": bit.name,
      title: "Each step is a clock edge",
      disabled: true,
    },
    element("span", { class: "name" }, bit.name),
    element("span", { class: "edge", "aria-hidden": "true" }, "↑ each step"),
  );
}
