// Keeping the designed body as a robot file, and using it in the program.

import type { Connection } from "../connection";
import { button, element } from "../element";
import { RequestError } from "../protocol";
import type { Body } from "./body";

export class Keeping {
  readonly host: HTMLElement;
  readonly #name = element("input", { type: "text", value: "my_robot", spellcheck: "false", "aria-label": "Name of the robot" });
  readonly #status = element("p", { class: "status", role: "status", "aria-live": "polite" });

  constructor(
    private readonly connection: Connection,
    private readonly body: () => Body,
    private readonly use: (line: string) => void,
    private readonly kept: () => void,
  ) {
    this.host = element(
      "div",
      { class: "keeping row" },
      element("label", {}, "name ", this.#name),
      button("Keep as a robot", () => void this.#keep(), { "data-do": "keep" }),
      this.#status,
    );
  }

  async #keep(): Promise<void> {
    try {
      const { path, use } = await this.connection.request("keep", { name: this.#name.value.trim(), body: [...this.body()] });
      this.use(use);
      this.#status.textContent = `wrote ${path}; the program has a line that uses it`;
      this.kept();
    } catch (error) {
      this.#status.textContent = error instanceof RequestError ? [error.message, error.help].filter(Boolean).join("; ") : String(error);
    }
  }
}
