// The frame of the page: a head, the editor and the live half with its tabs, and the divider between them.

import { element } from "./element";
import { recall, remember } from "./memory";
import { Observable } from "./observable";

export type TabName = "swarm" | "tests" | "robots" | "learn";

export interface Tab {
  name: TabName;
  label: string;
  panel: HTMLElement;
}

const NARROWEST = 18;
const WIDEST = 75;

export class Layout {
  readonly host: HTMLElement;
  readonly tab = new Observable<TabName>("swarm");
  readonly #buttons = new Map<TabName, HTMLButtonElement>();
  readonly #main = element("main");

  constructor(
    head: HTMLElement,
    edit: HTMLElement,
    strips: HTMLElement[],
    readonly tabs: Tab[],
  ) {
    const bar = element("div", { class: "tabs", role: "tablist", "aria-label": "Views" });
    const panels = tabs.map(tab => this.#panel(tab, bar));
    const live = element("section", { class: "live", "aria-label": "Live" }, bar, ...strips, ...panels);
    this.#main.append(edit, this.#divider(), live);
    this.host = element("div", { class: "page" }, head, this.#main);
    this.#resize(recall<number>("divide") ?? 38);
    this.show(recall<TabName>("tab") ?? "swarm");
    bar.addEventListener("keydown", event => this.#press(event));
  }

  show(name: TabName): void {
    for (const tab of this.tabs) {
      const chosen = tab.name === name;
      const made = this.#buttons.get(tab.name);
      made?.setAttribute("aria-selected", String(chosen));
      made?.setAttribute("tabindex", chosen ? "0" : "-1");
      tab.panel.parentElement?.toggleAttribute("hidden", !chosen);
    }
    remember("tab", name);
    // Where the whole page scrolls, as on a phone, the new tab begins at its top.
    scrollTo(0, 0);
    this.tab.set(name);
  }

  #panel({ name, label, panel }: Tab, bar: HTMLElement): HTMLElement {
    const made = element(
      "button",
      {
        type: "button",
        role: "tab",
        id: `tab-${name}`,
        "aria-controls": `panel-${name}`,
        onclick: () => this.show(name),
      },
      label,
    );
    this.#buttons.set(name, made);
    bar.append(made);
    return element(
      "div",
      { class: "panel", role: "tabpanel", id: `panel-${name}`, "aria-labelledby": `tab-${name}` },
      panel,
    );
  }

  #press(event: KeyboardEvent): void {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (step !== undefined) {
      const index = this.tabs.findIndex(tab => tab.name === this.tab.value);
      const next = this.tabs[(index + step + this.tabs.length) % this.tabs.length] as Tab;
      this.show(next.name);
      this.#buttons.get(next.name)?.focus();
      event.preventDefault();
    }
  }

  #divider(): HTMLElement {
    const divider = element("div", {
      class: "divider",
      role: "separator",
      tabindex: 0,
      "aria-orientation": "vertical",
      "aria-label": "Width of the editor",
      "aria-valuemin": NARROWEST,
      "aria-valuemax": WIDEST,
    });
    divider.addEventListener("pointerdown", event => {
      event.preventDefault();
      divider.setPointerCapture(event.pointerId);
      divider.onpointermove = moved => this.#resize((100 * moved.clientX) / innerWidth);
    });
    divider.addEventListener("pointerup", () => {
      divider.onpointermove = null;
    });
    divider.addEventListener("keydown", event => {
      const step = { ArrowLeft: -2, ArrowRight: 2 }[event.key];
      if (step !== undefined) {
        this.#resize((recall<number>("divide") ?? 38) + step);
      }
    });
    return divider;
  }

  #resize(share: number): void {
    const kept = Math.min(WIDEST, Math.max(NARROWEST, share));
    this.#main.style.setProperty("--divide", `${kept}%`);
    this.#main.querySelector(".divider")?.setAttribute("aria-valuenow", String(Math.round(kept)));
    remember("divide", kept);
  }
}
