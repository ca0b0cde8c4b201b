// Runs that end by themselves: after some cycles or clocks, or as soon as an output or a register has a value.

import { counted } from "../counted";
import { button, countIn, element, fill } from "../element";
import { closeOutside } from "../menu";
import { offsetOf, toNumber } from "../ports";
import type { StimulusSource, ShownSwarm } from "../protocol";
import { halfOf, likelyClock } from "./clock";
import { typedNumber, type Valued } from "./numbers";
import type { LiveSwarm } from "./swarm";

export class RunUntil {
  readonly host = element("details", { class: "menu until" });
  readonly #name = element("summary");
  readonly #sheet = element("div", { class: "sheet" });
  #end: () => void = () => {};

  constructor(private readonly swarm: LiveSwarm) {
    this.host.append(this.#name, this.#sheet);
    closeOutside(this.host);
    swarm.definition.follow(definition => this.#build(definition));
    swarm.running.on(running => running || this.#end());
  }

  #build(definition: ShownSwarm | null): void {
    this.#end();
    this.#name.textContent = "Run until";
    const count = element("input", { type: "number", min: 1, max: 100_000, value: 10, "aria-label": "How many" });
    const [clock] = definition === null ? [] : likelyClock(definition);
    const more = (cycles: number, what: string): void => {
      const times = countIn(count);
      const last = (this.swarm.frame.value?.now ?? 0) + cycles * times;
      this.#run(`${counted(times, what)} later`, cycle => cycle >= last);
    };
    const clocks = (): void => {
      const half = this.swarm.clock.value?.half ?? halfOf(definition as ShownSwarm, clock?.index ?? 0);
      if (this.swarm.clock.value === null) {
        this.swarm.setClock({ bit: clock?.index ?? 0, half });
      }
      more(2 * half, "clock");
    };
    fill(
      this.#sheet,
      element(
        "p",
        { class: "row" },
        count,
        button("cycles later", () => more(1, "cycle"), { "data-do": "until-cycles" }),
        clock !== undefined && button("clocks later", clocks, { "data-do": "until-clocks" }),
      ),
      definition !== null && this.#values(definition),
    );
  }

  #values(definition: ShownSwarm): HTMLElement {
    const { outputs, shown, registers } = definition;
    const ports = outputs.map(port => {
      const start = offsetOf(outputs, port);
      return { port: port as Valued, name: port.name, sources: shown.slice(start, start + port.width) };
    });
    const kept = registers.filter(({ name }) => !outputs.some(port => port.name === name));
    const all = [
      ...ports,
      ...kept.map(({ name, robots }) => ({
        port: { width: robots.length },
        name,
        sources: robots.map((robot): StimulusSource => ({ robot })),
      })),
    ];
    const which = element(
      "select",
      { "aria-label": "Output or register" },
      ...all.map(({ name }, i) => element("option", { value: i }, name)),
    );
    const field = element("input", {
      type: "text",
      class: "value",
      value: "1",
      "aria-label": "Value",
      spellcheck: "false",
    });
    const run = (): void => {
      const chosen = all[Number(which.value)];
      const value = chosen === undefined ? null : typedNumber(field.value, chosen.port);
      field.setAttribute("aria-invalid", String(value === null));
      if (chosen !== undefined && value !== null) {
        const bits = (cycle: number): number[] => chosen.sources.map(source => this.swarm.value(source, cycle) ?? 0);
        this.#run(`${chosen.name} is ${field.value}`, cycle => toNumber(bits(cycle)) === value);
      }
    };
    return element("p", { class: "row" }, which, " is ", field, button("Run", run, { "data-do": "until-value" }));
  }

  /** Runs up to the first cycle from now on for which this holds. */
  #run(text: string, isLast: (cycle: number) => boolean): void {
    const { swarm } = this;
    this.#end();
    this.host.open = false;
    let seen = swarm.frame.value?.now ?? 0;
    const forget = swarm.frame.on(frame => {
      const now = frame?.now ?? 0;
      while (seen < now) {
        seen++;
        if (isLast(seen)) {
          this.#end();
          // A fast run has gone on meanwhile.
          void swarm.seek(seen);
          return;
        }
      }
      seen = now;
    });
    this.#name.textContent = `Until ${text}`;
    this.#end = () => {
      forget();
      this.#name.textContent = "Run until";
      this.#end = () => {};
    };
    swarm.play();
  }
}
