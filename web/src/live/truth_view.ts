// The truth table beside the robots: the row of the present inputs is marked, and a click on another one sets them.

import { button, element, fill } from "../element";
import { recall, remember } from "../memory";
import { bitsOf, totalWidth } from "../ports";
import type { ShownSwarm } from "../protocol";
import type { LiveSwarm } from "./swarm";

/** Circuits with more bits of inputs have no table: it would be too long to read. */
const MOST_BITS = 5;

export class TruthView {
  readonly host = element("div", { class: "table", tabindex: 0, role: "group", "aria-label": "Truth table" });
  readonly toggle = button("Truth table", () => this.#switch(), {
    "data-do": "truth",
    title: "What the outputs are for all inputs",
  });
  #open = recall<boolean>("truth") ?? false;
  #rows = new Map<string, HTMLElement>();
  #marked: HTMLElement | undefined;

  constructor(private readonly swarm: LiveSwarm) {
    swarm.definition.follow(definition => void this.#build(definition));
    swarm.inputs.on(() => this.#mark());
  }

  #switch(): void {
    this.#open = !this.#open;
    remember("truth", this.#open);
    this.#showOpen();
  }

  #showOpen(): void {
    const none = this.#rows.size === 0;
    this.toggle.hidden = none;
    this.toggle.setAttribute("aria-pressed", String(this.#open));
    this.host.hidden = none || !this.#open;
  }

  async #build(definition: ShownSwarm | null): Promise<void> {
    this.#rows.clear();
    this.host.replaceChildren();
    this.#showOpen();
    const width = totalWidth(definition?.inputs ?? []);
    if (definition === null || width === 0 || width > MOST_BITS) {
      return;
    }
    const rows = Array.from({ length: 1 << width }, (_, row) => row.toString(2).padStart(width, "0"));
    const outputs = await this.swarm.settled(rows);
    if (outputs !== null && definition === this.swarm.definition.value) {
      fill(this.host, this.#table(definition, rows, outputs));
      this.#showOpen();
      this.#mark();
    }
  }

  #table({ inputs, outputs }: ShownSwarm, rows: string[], found: string[]): HTMLElement {
    const names = (ports: ShownSwarm["inputs"]): HTMLElement[] =>
      bitsOf(ports).map(({ name }, i) => element("th", { scope: "col", class: i === 0 ? "first" : null }, name));
    const head = element("tr", {}, element("th"), ...names(inputs), ...names(outputs));
    return element(
      "table",
      { class: "rows" },
      element("thead", {}, head),
      element("tbody", {}, ...rows.map((row, at) => this.#row(row, found[at] ?? ""))),
    );
  }

  #row(inputs: string, outputs: string): HTMLElement {
    const cells = (bits: string): HTMLElement[] =>
      [...bits].map((bit, i) => element("td", { "data-value": bit, class: i === 0 ? "first" : null }, bit));
    // The row does it, too; the button is for the keyboard.
    const set = button("▸", () => {}, {
      class: "link",
      "aria-label": `set the inputs to ${inputs}`,
      title: "Set the inputs to this row",
    });
    const made = element(
      "tr",
      { "data-row": inputs, onclick: () => this.swarm.setInputs(inputs) },
      element("td", {}, set),
      ...cells(inputs),
      ...cells(outputs),
    );
    this.#rows.set(inputs, made);
    return made;
  }

  #mark(): void {
    this.#marked?.removeAttribute("aria-current");
    this.#marked = this.#rows.get(this.swarm.inputs.value);
    this.#marked?.setAttribute("aria-current", "true");
    if (this.#marked !== undefined && !this.host.hidden) {
      // Only the table scrolls, not the page around it.
      const [top, height] = [this.#marked.offsetTop, this.#marked.offsetHeight];
      const { scrollTop, clientHeight } = this.host;
      this.host.scrollTop = Math.min(top, Math.max(scrollTop, top + height - clientHeight));
    }
  }
}
