// Links to the program, in the menu of what can be taken away.

import { button, element, fill } from "../element";
import { LinkError, encodeShare, type SharedProgram } from "./link";

export interface LinkPlaces {
  /** The address of this page, if others can open it. */
  here: string | null;
  /** Whether everybody can: it has no secret in it. */
  isPublic: boolean;
  /** The address of a page that everybody can open, if one is known. */
  publicPage: string | null;
}

export class LinkMenu {
  readonly host = element("div", { class: "links" });
  readonly #status = element("p", { class: "status", role: "status", "aria-live": "polite" });

  constructor(private readonly share: () => SharedProgram) {}

  show({ here, isPublic, publicPage }: LinkPlaces): void {
    const open = publicPage ?? (isPublic ? here : null);
    const isElsewhere = publicPage !== null && publicPage !== here;
    fill(this.#status);
    fill(
      this.host,
      here !== null && isPublic && this.#button("Copy a link to this page", here, "link", "Whoever has it can open it"),
      here !== null &&
        !isPublic &&
        this.#button("Copy a link for this server", here, "link", "Whoever has this link can use this server"),
      isElsewhere &&
        this.#button(
          "Copy a link to the public page",
          publicPage,
          "public-link",
          `Whoever has it can open it, at ${publicPage}`,
        ),
      this.#button(
        "Copy a link for any nbc play",
        "",
        "any-link",
        "To be pasted into Open a program, or behind the address of another nbc play",
      ),
      open !== null && this.#button("Copy as Markdown", open, "markdown", "The program with a link to it", true),
      this.#status,
    );
  }

  #button(label: string, address: string, what: string, title: string, isMarkdown = false): HTMLElement {
    return button(label, () => void this.#copy(address, isMarkdown), { "data-take": what, title });
  }

  async #copy(address: string, isMarkdown: boolean): Promise<void> {
    try {
      const shared = this.share();
      const link = `${address}#${await encodeShare(shared)}`;
      await this.#put(isMarkdown ? `\`\`\`nb\n${shared.text}\`\`\`\n\n[${shared.file}](${link})\n` : link);
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
      fill(this.#status, `copied, ${link.length} letters; the program is in it`);
    } catch {
      const field = element("input", { type: "text", value: link, readonly: true, "aria-label": "The link" });
      fill(this.#status, "Copy it from here: ", field);
      field.select();
    }
  }
}
