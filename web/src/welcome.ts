// What one sees here: above the swarm until it is closed, and in the help with the keys.

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
  /** The strip above the swarm. */
  readonly strip = element("aside", { class: "welcome", "aria-label": "What one sees here", hidden: true });
  readonly help: HTMLButtonElement;

  constructor(
    private readonly swarm: LiveSwarm,
    private readonly learn: () => void,
  ) {
    this.help = button("Help", () => this.#open(), { "data-do": "help" });
    if (recall(KNOWN) === null) {
      this.swarm.definition.on(() => this.#show());
    }
  }

  /** Four sentences, the last of which names a switch of the circuit. */
  #sentences(): HTMLElement {
    const definition = this.swarm.definition.value;
    const input = bitsOf(definition?.inputs ?? []).find(bit => bit.index !== definition?.waves?.clock);
    const output = definition?.outputs[0];
    return element(
      "p",
      {},
      "These are soft robots without a brain. ",
      "A body reacts to two stimuli by its shape alone: it walks right for 1 and left for 0, so it is a logic gate. ",
      "The motion of one robot is a stimulus of the next, and together they compute the program beside them. ",
      ...(input === undefined || output === undefined
        ? ["Press Run and see them walk."]
        : [
            "Flip the switch ",
            element("b", {}, input.name),
            " and see which robots turn round, and whether ",
            element("b", {}, output.name),
            " changes.",
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
      button("Learn it in lessons", () => this.#close(this.learn), { class: "primary", "data-do": "lessons" }),
      iconButton("close", "Close this", () => this.#close()),
    );
  }

  /** Whoever begins a lesson has read enough. */
  close(): void {
    this.#close();
  }

  #close(then: () => void = () => {}): void {
    remember(KNOWN, true);
    this.strip.hidden = true;
    then();
  }

  #open(): void {
    const dialog = element(
      "dialog",
      { class: "help", "aria-label": "Help" },
      element(
        "header",
        {},
        element("h2", {}, "What one sees here"),
        iconButton("close", "Close", () => dialog.close()),
      ),
      this.#sentences(),
      element(
        "p",
        {},
        button("Learn it in lessons", () => (dialog.close(), this.learn()), { class: "primary" }),
      ),
      element("h3", {}, "Keys"),
      element(
        "dl",
        {},
        ...KEYS.flatMap(([keys, does]) => [element("dt", {}, element("kbd", {}, keys)), element("dd", {}, does)]),
      ),
    );
    dialog.onclose = () => dialog.remove();
    dialog.onclick = event => event.target === dialog && dialog.close();
    document.body.append(dialog);
    dialog.showModal();
  }
}
