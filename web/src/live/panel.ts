// The tab with the swarm: what it is, its inputs and outputs, the stage and the diagrams.

import { button, element, fill, iconButton } from "../element";
import type { Choice, Program, Stage as CompileStage } from "../program";
import { recall, remember } from "../memory";
import { totalWidth } from "../ports";
import { colors } from "../theme";
import { Animation } from "./animation";
import { ClockPanel } from "./clock";
import { Controls } from "./controls";
import { InputPanel } from "./inputs";
import { Inspector } from "./inspector";
import { legend } from "./legend";
import { OutputPanel } from "./outputs";
import { Schematic } from "./schematic";
import { Spacetime } from "./spacetime";
import { Stage } from "./stage";
import type { LiveSwarm } from "./swarm";
import { Timeline } from "./timeline";
import { Waveform } from "./waveform";

export class SwarmPanel {
  readonly host = element("div", { class: "swarm" });
  readonly controls: Controls;
  readonly stage: Stage;
  readonly #animation: Animation;
  readonly #choices = element("select", { class: "circuit", "aria-label": "The circuit and swarm that is shown" });
  readonly #status = element("p", { class: "status", role: "status", "aria-live": "polite" });
  readonly #legend = element("div", { class: "legends" });

  constructor(
    private readonly program: Program,
    private readonly swarm: LiveSwarm,
    takeAway: HTMLElement,
  ) {
    this.#animation = new Animation(swarm);
    const wake = (): void => this.#animation.wake();
    const timeline = new Timeline();
    const [inputs, outputs] = [new InputPanel(swarm), new OutputPanel(swarm)];
    this.controls = new Controls(swarm);
    this.stage = new Stage(swarm, wake);
    const inspector = new Inspector(swarm);
    const schematic = new Schematic(swarm);
    const [waveform, spacetime] = [new Waveform(swarm, timeline, wake), new Spacetime(swarm, timeline, wake)];
    const clock = new ClockPanel(swarm);
    this.host.append(
      element("div", { class: "head" }, this.#choices, this.#status, firstHint(swarm), takeAway),
      element("div", { class: "ports" }, inputs.host, clock.host, outputs.host),
      this.controls.host,
      element("div", { class: "scene" }, this.stage.pane.host, inspector.host),
      element("div", { class: "diagrams" }, schematic.host, diagrams(waveform, spacetime, timeline)),
      this.#legend,
    );
    for (const view of [inputs, outputs, this.stage, inspector, schematic, waveform, spacetime]) {
      this.#animation.add(view);
    }
    this.#follow(wake);
  }

  wake(): void {
    this.#animation.wake();
  }

  #follow(wake: () => void): void {
    const { program, swarm } = this;
    this.#choices.onchange = () => program.choose(JSON.parse(this.#choices.value) as Choice);
    program.checked.on(() => this.#listChoices());
    program.choice.on(() => this.#listChoices());
    program.stage.follow(stage => this.#showStage(stage));
    swarm.stopped.on(() => this.#showStage(program.stage.value));
    swarm.definition.on(definition => {
      const looks = (definition?.looks ?? []).map(look => ({ look, name: MATERIALS[look.name] ?? look.name }));
      fill(this.#legend, legend(looks, definition?.waves?.threads ?? 1));
    });
    swarm.selection.pointed.on(wake);
    swarm.selection.followed.on(wake);
    swarm.definition.on(wake);
    colors.on(wake);
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
        fill(
          this.#status,
          `${stage.count === 1 ? "1 error" : `${stage.count} errors`} in the program; these robots are from before`,
        );
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

  #summary(): string {
    const definition = this.swarm.definition.value;
    if (definition === null) {
      return "";
    }
    const count = definition.robots.length;
    const { hold, waves } = definition;
    if (waves !== null) {
      const machines = waves.threads === 1 ? "one thread" : `${waves.threads} threads at once`;
      const step = `${waves.step} ${waves.step === 1 ? "cycle" : "cycles"}`;
      return `${count} ${count === 1 ? "robot" : "robots"}, a step of ${step}, ${machines}`;
    }
    const settles = `, settles within ${hold} ${hold === 1 ? "cycle" : "cycles"}`;
    return `${count} ${count === 1 ? "robot" : "robots"}${settles}`;
  }
}

/** What the materials of the paper do, and those of a third stimulus. */
const MATERIALS: Record<string, string> = {
  bone: "bone: rigid",
  flesh: "flesh: soft",
  muscle: "muscle: swells and shrinks by itself",
  antimuscle: "antimuscle: the same, in antiphase",
  s1_shrink: "shrinks while stimulus 1 is present",
  s2_shrink: "shrinks while stimulus 2 is present",
  s1_grow: "grows while stimulus 1 is present",
  s2_grow: "grows while stimulus 2 is present",
  s3_shrink: "shrinks while stimulus 3 is present",
  s3_grow: "grows while stimulus 3 is present",
};

/** Until the first switch was flipped. */
function firstHint(swarm: LiveSwarm): HTMLElement {
  const hint = element(
    "span",
    { class: "hint", role: "note", hidden: recall("flipped") === true },
    "▼ flip a switch: robots turn round",
  );
  const note = (): void => {
    if (swarm.inputs.value.includes("1") || swarm.clock.value !== null) {
      hint.hidden = true;
      remember("flipped", true);
    }
  };
  swarm.inputs.on(note);
  swarm.clock.on(note);
  swarm.definition.on(definition => {
    const switches = totalWidth(definition?.inputs ?? []) - Number((definition?.waves?.clock ?? null) !== null);
    hint.classList.toggle("needless", definition !== null && switches === 0);
  });
  return hint;
}

function diagrams(waveform: Waveform, spacetime: Spacetime, timeline: Timeline): HTMLElement {
  return element(
    "div",
    { class: "times" },
    element(
      "div",
      { class: "zoom" },
      iconButton("more", "Show fewer cycles", () => timeline.zoomBy(1)),
      iconButton("less", "Show more cycles", () => timeline.zoomBy(-1)),
    ),
    waveform.pane.host,
    spacetime.pane.host,
  );
}
