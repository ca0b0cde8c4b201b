// The outputs: a lamp for each bit, and the number of each bus.

import { element, fill } from "../element";
import { offsetOf, toNumber } from "../ports";
import type { StimulusSource, Column, ShownSwarm } from "../protocol";
import type { View } from "./animation";
import { FORMATS, numberFormat, numberText, type NumberFormat } from "./numbers";
import type { LiveSwarm } from "./swarm";

/** Wider buses have no lamps, only their number. */
const LIT = 16;
/** The robots of larger circuits need so long that what they will show is said at once. */
const LARGE = 100;

export class OutputPanel implements View {
  readonly host = element("div", { class: "outputs", role: "group", "aria-label": "Outputs" });
  #updates: (() => void)[] = [];

  constructor(private readonly swarm: LiveSwarm) {
    swarm.definition.on(() => this.#build());
    numberFormat.on(() => this.draw());
    swarm.inputs.on(() => this.draw());
  }

  draw(): void {
    for (const update of this.#updates) {
      update();
    }
  }

  #build(): void {
    const definition = this.swarm.definition.value;
    this.#updates = [];
    const ports = definition?.outputs ?? [];
    fill(
      this.host,
      element("span", { class: "caption" }, "Outputs"),
      ...ports.map(port => {
        const start = offsetOf(ports, port);
        return this.#port(port, definition?.shown.slice(start, start + port.width) ?? []);
      }),
      definition !== null && definition.robots.length > LARGE && this.#logic(definition),
      this.#hasNumbers() && formatChoice(),
    );
    this.draw();
  }

  /** Whether any number is shown, for which one can choose how it is written. */
  #hasNumbers(): boolean {
    const { inputs = [], outputs = [], registers = [], waves = null } = this.swarm.definition.value ?? {};
    const wide = [...inputs, ...outputs].some(({ width, members }) => width > 1 || members !== undefined);
    const kept = [...registers.map(({ robots }) => robots), ...(waves?.registers ?? []).map(({ bits }) => bits)];
    return wide || kept.some(bits => bits.length > 1);
  }

  /** Hidden for a circuit with a state. */
  #logic({ outputs }: ShownSwarm): HTMLElement {
    const title = "What the robots will show once they have settled";
    const text = element("output", { class: "logic", hidden: true, title });
    let known: string | null = "";
    const show = async (key: string, inputs: string): Promise<void> => {
      known = key;
      const settled = await this.swarm.settled([inputs]);
      if (settled === null) {
        known = null;
      } else if (key === known) {
        const bits = [...(settled[0] ?? "")].map(Number);
        const values = outputs.map(port => {
          const start = offsetOf(outputs, port);
          return `${port.name} = ${numberText(toNumber(bits.slice(start, start + port.width)), port)}`;
        });
        text.textContent = `soon ${values.join(", ")}`;
        text.hidden = false;
      }
    };
    this.#updates.push(() => {
      const key = `${numberFormat.value} ${this.swarm.inputs.value}`;
      if (known !== null && key !== known) {
        void show(key, this.swarm.inputs.value);
      }
    });
    return text;
  }

  #port(port: Column, sources: StimulusSource[]): HTMLElement {
    const lamps = sources.map((source, i) =>
      this.#lamp(source, port.width === 1 ? port.name : `${port.name}[${port.width - 1 - i}]`),
    );
    const few = port.width <= LIT;
    const number = element("output", { class: "number", "data-output": port.name });
    const numbered = port.width > 1 || port.members !== undefined;
    if (numbered) {
      this.#updates.push(() => {
        const values = sources.map(source => this.swarm.value(source));
        const text = values.includes(null) ? "–" : numberText(toNumber(values as number[]), port);
        if (number.textContent !== text) {
          number.textContent = text;
        }
      });
    }
    return element(
      "div",
      { class: "output" },
      element("span", { class: "name" }, port.name),
      few && element("span", { class: port.width > 1 ? "lamps small" : "lamps" }, ...lamps),
      numbered && number,
    );
  }

  #lamp(source: StimulusSource, name: string): HTMLElement {
    const lamp = element("span", {
      class: "lamp",
      role: "img",
      "data-lamp": name,
      onmouseenter: () => this.swarm.selection.point(source),
      onmouseleave: () => this.swarm.selection.point(null),
    });
    let shown: number | null | undefined;
    this.#updates.push(() => {
      const value = this.swarm.value(source);
      if (value !== shown) {
        shown = value;
        lamp.dataset["value"] = value === null ? "" : String(value);
        lamp.textContent = value === null ? "–" : String(value);
        lamp.setAttribute("aria-label", `output ${name} is ${value ?? "not known yet"}`);
      }
    });
    return lamp;
  }
}

function formatChoice(): HTMLElement {
  return element(
    "select",
    {
      class: "format",
      "aria-label": "How numbers are written",
      title: "How numbers are written",
      onchange: event => numberFormat.set((event.target as HTMLSelectElement).value as NumberFormat),
    },
    ...FORMATS.map(([name, label]) => element("option", { value: name, selected: name === numberFormat.value }, label)),
  );
}
