// Messages with something to do, above the editor; each stays until it is answered.

import { button, element, iconButton } from "./element";

export interface Action {
  label: string;
  run: () => void;
}

export class Notices {
  readonly host = element("div", { class: "notices", role: "status", "aria-live": "polite" });
  readonly #shown = new Map<string, HTMLElement>();

  show(name: string, text: string, actions: Action[] = []): void {
    this.hide(name);
    const choices = actions.map(({ label, run }) =>
      button(label, () => {
        this.hide(name);
        run();
      }),
    );
    const close = iconButton("close", "Close this message", () => this.hide(name));
    const notice = element("div", { class: "notice", "data-notice": name }, element("p", {}, text), ...choices, close);
    this.#shown.set(name, notice);
    this.host.append(notice);
  }

  hide(name: string): void {
    this.#shown.get(name)?.remove();
    this.#shown.delete(name);
  }

  clear(): void {
    [...this.#shown.keys()].forEach(name => this.hide(name));
  }
}
