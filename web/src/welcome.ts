// What one sees here: above the swarm until it is closed, and in the help with the keys.

import { ask } from "./dialog";
import { button, element, fill, iconButton } from "./element";
import type { LiveSwarm } from "./live/swarm";
import { recall, remember } from "./memory";
import { bitsOf } from "./ports";

const KNOWN = "welcomed";

const KEYS: [string, string][] = [
  ["Space", "run or pause the robots"],
  [".", "one cycle"],
  ["F", "let a pane fill the page; Escape goes back"],
  ["+ - 0", "zoom the schematic, and show all of it"],
  ["Ctrl+S", "save the program"],
  ["Ctrl+Space", "propose what to write"],
  ["Ctrl+.", "correct the error at the cursor"],
  ["F12", "go to where a name is declared"],
  ["F2", "rename"],
  ["Shift+Alt+F", "format the program"],
];

export class Welcome {
  readonly strip = element("aside", { class: "welcome", "aria-label": "What one sees here", hidden: true });
  readonly help: HTMLButtonElement;

  constructor(
    private readonly swarm: LiveSwarm,
    private readonly learn: () => void,
  ) {
    this.help = button("Help", () => void this.#open(), { "data-do": "help" });
    if (recall(KNOWN) === null) {
      this.swarm.definition.on(() => this.#show());
    }
  }

  #sentences(): HTMLElement {
    const definition = this.swarm.definition.value;
    const input = bitsOf(definition?.inputs ?? []).find(bit => bit.index !== definition?.waves?.clock);
    return element(
      "p",
      {},
      "Soft robots without a brain compute this program: each walks right for 1 and left for 0. Its shape decides how ",
      "it reacts to the motion of others. ",
      ...(input === undefined
        ? ["Press Run and see them walk."]
        : [
            input.port.width === 1 ? "Flip the switch " : "Change ",
            element("b", {}, input.port.name),
            " and see which of them turn round.",
          ]),
    );
  }

  #show(): void {
    if (recall(KNOWN) !== null) {
      return;
    }
    this.strip.hidden = false;
    fill(
      this.strip,
      this.#sentences(),
      button("Learn it in lessons", () => this.close(this.learn), { class: "primary", "data-do": "lessons" }),
      iconButton("close", "Close this", () => this.close()),
    );
  }

  close(then: () => void = () => {}): void {
    remember(KNOWN, true);
    this.strip.hidden = true;
    then();
  }

  async #open(): Promise<void> {
    const learns = await ask<boolean>("Help", "help", close => [
      element(
        "header",
        {},
        element("h2", {}, "What one sees here"),
        iconButton("close", "Close", () => close(false)),
      ),
      this.#sentences(),
      element(
        "p",
        {},
        button("Learn it in lessons", () => close(true), { class: "primary" }),
      ),
      element("h3", {}, "Keys"),
      element(
        "dl",
        {},
        ...KEYS.flatMap(([keys, does]) => [element("dt", {}, element("kbd", {}, keys)), element("dd", {}, does)]),
      ),
    ]);
    if (learns === true) {
      this.learn();
    }
  }
}
