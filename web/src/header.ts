// The head of the page: where one is, whether the server is there, and how the page looks.

import type { ConnectionState } from "./connection";
import { button, element, iconButton } from "./element";
import type { Greeting } from "./protocol";
import { switchProjector, switchTheme, theme } from "./theme";

/** After this long without a server, its address may have changed. */
const LONG = 15_000;

export class Header {
  readonly host: HTMLElement;
  readonly #folder = element("span", { class: "folder" });
  readonly #status = element("span", { class: "status", role: "status" });
  readonly #banner = element("div", { class: "banner", role: "alert", hidden: true });
  #timer = 0;

  constructor() {
    const projector = iconButton(
      "projector",
      "Large type, for a projector",
      () => {
        projector.setAttribute("aria-pressed", String(switchProjector()));
      },
      { "data-do": "projector" },
    );
    projector.setAttribute("aria-pressed", String(document.documentElement.hasAttribute("data-projector")));
    const light = iconButton(
      "theme",
      "Light or dark",
      () => {
        switchTheme();
        light.setAttribute("aria-pressed", String(theme() === "dark"));
      },
      { "data-do": "theme" },
    );
    this.host = element(
      "header",
      { class: "head" },
      element("h1", {}, element("span", { class: "mark", "aria-hidden": "true" }), "nbc"),
      this.#folder,
      this.#status,
      element("span", { class: "space" }),
      projector,
      light,
      this.#banner,
    );
  }

  showFolder(hello: Greeting): void {
    this.#folder.textContent = hello.folder;
    this.#folder.title = `nbc ${hello.version}, in the folder ${hello.folder}`;
  }

  offer(label: string, run: () => void): void {
    this.#status.after(button(label, run, { class: "offer" }));
    this.offer = () => {};
  }

  add(...made: HTMLElement[]): void {
    this.host.querySelector(".space")?.after(...made);
  }

  showStatus(text: string): void {
    this.#status.textContent = text;
  }

  showConnection(state: ConnectionState): void {
    clearTimeout(this.#timer);
    this.#banner.hidden = state !== "lost";
    if (state === "lost") {
      this.#banner.textContent ||= "Connection lost – trying again. Your text is safe.";
      this.#timer = window.setTimeout(() => this.#advise(), LONG);
    } else if (state === "open") {
      this.#banner.textContent = "";
    }
  }

  #advise(): void {
    this.#banner.textContent =
      "Connection lost – trying again. If you have started nbc play anew, open the address that it prints.";
  }
}
