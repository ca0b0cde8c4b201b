// What a circuit keeps, beside the robots: its registers by name, and the table over an output of it, such as the
// program of a machine, with the row that holds now; and the environment of a test that gives its inputs.

import { button, element, fill } from "../element";
import { recall, remember } from "../memory";
import { offsetOf, toNumber } from "../ports";
import type { StimulusSource, ListingRow, ShownEnvironment, ShownSwarm, ShownWaves } from "../protocol";
import type { View } from "./animation";
import { environmentView } from "./environment_view";
import { numberFormat, numberText, type Valued } from "./numbers";
import type { LiveSwarm } from "./swarm";
import { registerAt, threadColor } from "./waves";

export function rowFor(rows: ListingRow[], digits: string): number | null {
  const fits = (bits: string): boolean =>
    bits.length === digits.length && [...bits].every((bit, i) => bit === "-" || bit === digits[i]);
  const found = rows.findIndex(({ bits }) => fits(bits));
  return found < 0 ? null : found;
}

export class StateView implements View {
  readonly host = element("div", { class: "table state", tabindex: 0, role: "group", "aria-label": "State" });
  readonly toggle = button("State", () => this.#switch(), { "data-do": "state" });
  #open = recall<boolean>("state") ?? false;
  #updates: (() => void)[] = [];

  constructor(private readonly swarm: LiveSwarm) {
    swarm.definition.follow(definition => this.#build(definition));
    swarm.scripted.on(() => this.#build(swarm.definition.value));
    numberFormat.on(() => this.draw());
  }

  draw(): void {
    if (!this.host.hidden) {
      this.#updates.forEach(update => update());
    }
  }

  #switch(): void {
    this.#open = !this.#open;
    remember("state", this.#open);
    this.#showOpen();
  }

  #showOpen(): void {
    this.toggle.hidden = this.#updates.length === 0;
    this.toggle.setAttribute("aria-pressed", String(this.#open));
    this.host.hidden = this.toggle.hidden || !this.#open;
    this.draw();
  }

  #build(definition: ShownSwarm | null): void {
    this.#updates = [];
    const { registers = [], listing = null, waves = null } = definition ?? {};
    const script = this.swarm.scripted.value > 0 ? (definition?.script ?? null) : null;
    // Who watches such a test wants to see its other side.
    this.#open ||= (script?.environment ?? null) !== null;
    this.toggle.title = listing === null ? "The registers" : "The registers, and the rows of the program";
    fill(
      this.host,
      definition !== null && registers.length > 0 && this.#registers(definition),
      definition !== null && waves !== null && waves.registers.length > 0 && this.#waveRegisters(definition, waves),
      definition !== null && listing !== null && this.#listing(definition, listing),
      ...(script?.environment ? this.#environment(script.environment) : []),
    );
    this.#showOpen();
  }

  #environment(environment: ShownEnvironment): HTMLElement[] {
    const { parts, show } = environmentView(environment);
    this.#updates.push(() => show(this.swarm.playback.cycle));
    return parts;
  }

  #registers({ registers, outputs }: ShownSwarm): HTMLElement {
    const rows = registers.map(({ name, robots }) => {
      const sources = robots.map(robot => ({ robot }));
      const value = element("td", { "data-register": name });
      // One that is an output may have its enumeration.
      const valued = outputs.find(port => port.name === name && port.width === robots.length) ?? {
        width: robots.length,
      };
      this.#updates.push(() => setText(value, this.#text(sources, valued)));
      const point = (source: StimulusSource | null): void => this.swarm.selection.point(source);
      const pointed = { onmouseenter: () => point(sources[0] ?? null), onmouseleave: () => point(null) };
      return element("tr", pointed, element("th", { scope: "row" }, name), value);
    });
    return element("table", { class: "rows registers", "aria-label": "Registers" }, element("tbody", {}, ...rows));
  }

  #waveRegisters({ outputs }: ShownSwarm, waves: ShownWaves): HTMLElement {
    const threads = Array.from({ length: waves.threads }, (_, thread) => thread);
    const rows = waves.registers.map(register => {
      const { name, bits } = register;
      const valued = outputs.find(port => port.name === name && port.width === bits.length) ?? { width: bits.length };
      const values = threads.map(thread => {
        const value = element("td", { "data-register": name, "data-of": thread + 1 });
        this.#updates.push(() => {
          const place = { thread, cycle: this.swarm.playback.cycle };
          const seen = registerAt(waves, register, place, (source, cycle) => this.swarm.value(source, cycle));
          setText(value, seen === null ? "–" : numberText(toNumber(seen), valued));
        });
        return value;
      });
      return element("tr", {}, element("th", { scope: "row" }, name), ...values);
    });
    const heads = threads.map(thread =>
      element(
        "th",
        { scope: "col", title: `Thread ${thread + 1}` },
        element("span", { class: "badge", "data-thread": threadColor(thread) }, String(thread + 1)),
      ),
    );
    return element(
      "table",
      { class: "rows registers", "aria-label": "Registers" },
      element("caption", {}, "after the last step"),
      threads.length > 1 && element("thead", {}, element("tr", {}, element("td"), ...heads)),
      element("tbody", {}, ...rows),
    );
  }

  #text(sources: StimulusSource[], valued: Valued): string {
    const values = sources.map(source => this.swarm.value(source));
    return values.includes(null) ? "–" : numberText(toNumber(values as number[]), valued);
  }

  #listing({ outputs, shown }: ShownSwarm, { port, rows }: NonNullable<ShownSwarm["listing"]>): HTMLElement {
    const made = rows.map(({ at, text, line }) =>
      element("tr", { title: `line ${line}` }, element("th", { scope: "row" }, at), element("td", {}, text)),
    );
    const entry = outputs.find(({ name }) => name === port);
    const start = entry === undefined ? 0 : offsetOf(outputs, entry);
    const sources = shown.slice(start, start + (entry?.width ?? 0));
    let before: number | null = null;
    this.#updates.push(() => {
      const row = rowFor(rows, sources.map(source => String(this.swarm.value(source) ?? "?")).join(""));
      if (row !== before) {
        before = row;
        made.forEach((one, i) =>
          i === row ? one.setAttribute("aria-current", "true") : one.removeAttribute("aria-current"),
        );
      }
    });
    return element(
      "table",
      { class: "rows listing" },
      element("caption", {}, `by ${port}`),
      element("tbody", {}, ...made),
    );
  }
}

function setText(part: HTMLElement, text: string): void {
  if (part.textContent !== text) {
    part.textContent = text;
  }
}
