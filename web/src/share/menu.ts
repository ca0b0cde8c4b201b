// Links to the program, in the menu of what can be taken away.

import { button, element, fill } from "../element";
import { LinkError, encodeShare, type SharedProgram } from "./link";

export class LinkMenu {
  readonly host: HTMLElement;
  readonly #status = element("p", { class: "status", role: "status", "aria-live": "polite" });

  constructor(private readonly share: () => SharedProgram) {
    this.host = element(
      "div",
      { class: "links" },
      button("Copy a link for this server", () => void this.#copy(location.href.replace(/#.*/, "")), {
        "data-take": "link",
        title: "Whoever has this link can use this server",
      }),
      button("Copy a link for any nbc play", () => void this.#copy(""), {
        "data-take": "any-link",
        title: "To be pasted into Open a program, or behind the address of another nbc play",
      }),
      this.#status,
    );
  }

  async #copy(address: string): Promise<void> {
    try {
      const link = `${address}#${await encodeShare(this.share())}`;
      await this.#put(link);
    } catch (error) {
      if (!(error instanceof LinkError)) {
        throw error;
      }
      fill(this.#status, `Cannot make a link: ${error.message}.`);
    }
  }

  /** Puts a link onto the clipboard; where a browser forbids that, into a field. */
  async #put(link: string): Promise<void> {
    try {
      await navigator.clipboard.writeText(link);
      fill(this.#status, `copied, ${link.length} letters; the program is in the link itself`);
    } catch {
      const field = element("input", { type: "text", value: link, readonly: true, "aria-label": "The link" });
      fill(this.#status, "Copy it from here: ", field);
      field.select();
    }
  }
}
