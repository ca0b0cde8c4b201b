// A pane that fills the page, with the inputs and the controls above it: a button and the key F, and Escape goes back.

import { changeIcon, iconButton } from "../element";

export type PaneName = "stage" | "schematic" | "waveform" | "spacetime";

export class Filling {
  readonly #panes = new Map<PaneName, { pane: HTMLElement; made: HTMLButtonElement; what: string }>();

  constructor(private readonly whole: HTMLElement) {
    addEventListener("keydown", event => this.#press(event));
  }

  /** A button with which a pane fills the page; `what` it has. */
  button(name: PaneName, pane: HTMLElement, what: string): HTMLButtonElement {
    const made = iconButton("fill", "", () => this.#set(this.#filled === name ? null : name), { "data-fill": name });
    this.#panes.set(name, { pane, made, what });
    this.#show();
    return made;
  }

  get #filled(): string | null {
    return this.whole.dataset["filled"] ?? null;
  }

  #set(name: PaneName | null): void {
    // What is around the swarm is hidden, too.
    for (const part of [this.whole, document.body]) {
      if (name === null) {
        delete part.dataset["filled"];
      } else {
        part.dataset["filled"] = name;
      }
    }
    this.#show();
  }

  #show(): void {
    for (const [name, { pane, made, what }] of this.#panes) {
      const isFilled = this.#filled === name;
      pane.parentElement?.toggleAttribute("data-full", isFilled);
      changeIcon(made, isFilled ? "close" : "fill", isFilled ? "Back (Esc)" : `${what} fill the page (F)`);
      made.setAttribute("aria-pressed", String(isFilled));
    }
  }

  /** F fills with the pane that has the focus or is pointed at, else with the robots. */
  #press(event: KeyboardEvent): void {
    const target = event.composedPath()[0];
    const isTyping = target instanceof Element && target.closest("input, select, [contenteditable], dialog") !== null;
    if (isTyping || event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) {
      return;
    }
    if (event.key === "Escape" && this.#filled !== null) {
      this.#set(null);
    } else if (event.key === "f" && this.whole.checkVisibility()) {
      const names = [...this.#panes.keys()];
      const meant = (selector: string): PaneName | undefined =>
        names.find(name => this.#panes.get(name)?.pane.matches(selector));
      this.#set(this.#filled === null ? (meant(":focus-within") ?? meant(":hover") ?? "stage") : null);
    } else {
      return;
    }
    event.preventDefault();
  }
}
