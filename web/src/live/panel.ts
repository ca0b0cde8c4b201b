// The tab with the swarm: which circuit it is, how far it is compiled, and its views.

import { counted } from "../counted";
import { button, element, fill } from "../element";
import type { Choice, Program, Stage as CompileStage } from "../program";
import type { Controls } from "./controls";
import type { LiveSwarm } from "./swarm";
import { SwarmViews, summaryOf } from "./views";

export class SwarmPanel {
  readonly #choices = element("select", { class: "circuit", "aria-label": "The circuit and swarm that is shown" });
  readonly #status = element("p", { class: "status", role: "status", "aria-live": "polite" });
  readonly #views: SwarmViews;

  constructor(
    private readonly program: Program,
    private readonly swarm: LiveSwarm,
  ) {
    const head = element("div", { class: "head" }, this.#choices, this.#status);
    this.#views = new SwarmViews(swarm, head);
    this.#choices.onchange = () => program.choose(JSON.parse(this.#choices.value) as Choice);
    program.checked.on(() => this.#listChoices());
    program.choice.on(() => this.#listChoices());
    program.stage.follow(stage => this.#showStage(stage));
    swarm.stopped.on(() => this.#showStage(program.stage.value));
    program.checked.on(() => this.#showStage(program.stage.value));
    swarm.definition.on(() => this.#showStage(program.stage.value));
  }

  get host(): HTMLElement {
    return this.#views.host;
  }

  get controls(): Controls {
    return this.#views.controls;
  }

  wake(): void {
    this.#views.wake();
  }

  #listChoices(): void {
    const choices = this.program
      .circuits()
      .flatMap(({ circuit, swarms }) => [
        { label: circuit, value: { circuit, swarm: null } },
        ...swarms.map(swarm => ({ label: `${circuit} as ${swarm}`, value: { circuit, swarm } })),
      ]);
    const chosen = JSON.stringify(this.program.choice.value);
    fill(
      this.#choices,
      ...choices.map(({ label, value }) =>
        element("option", { value: JSON.stringify(value), selected: JSON.stringify(value) === chosen }, label),
      ),
    );
    this.#choices.hidden = choices.length === 0;
  }

  #showStage(stage: CompileStage): void {
    this.#status.dataset["state"] = stage.state;
    this.host.classList.toggle("stale", stage.state === "errors" || stage.state === "failed");
    this.host.classList.toggle("vacant", this.#isVacant() && (this.#hasNone() || stage.state === "errors"));
    this.host.classList.toggle("foreign", this.swarm.definition.value !== null && this.#isVacant());
    const reason = this.swarm.stopped.value;
    switch (stage.state) {
      case "compiling":
        fill(
          this.#status,
          `compiling ${stage.circuit} … `,
          button("Stop", () => this.program.cancel()),
        );
        return;
      case "errors":
        fill(this.#status, this.#withRobots(`${counted(stage.count, "error")} in the program`));
        return;
      case "failed":
        fill(
          this.#status,
          stage.message,
          stage.help === null ? null : element("span", { class: "help" }, ` ${stage.help}`),
        );
        return;
      default:
        fill(this.#status, reason === null ? this.#summary() : `The swarm has stopped: ${reason}`);
    }
  }

  /** Whether the program declares no circuit, but perhaps materials or evolutions. */
  #hasNone(): boolean {
    return this.program.checked.value?.circuits.length === 0;
  }

  #isVacant(): boolean {
    return this.swarm.definition.value === null || this.program.shown !== this.program.path.value;
  }

  #withRobots(text: string): string {
    return this.#isVacant() ? text : `${text}; these robots are from before`;
  }

  #summary(): string {
    if (this.#hasNone()) {
      return this.#withRobots("The program has no circuit");
    }
    const definition = this.swarm.definition.value;
    return definition === null ? "" : summaryOf(definition);
  }
}
