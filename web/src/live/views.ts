// The views of a swarm: its inputs and outputs, the controls, the stage and the diagrams.

import { button, element, fill, iconButton } from "../element";
import { recall, remember } from "../memory";
import type { ShownSwarm } from "../protocol";
import { colors } from "../colors";
import { Animation } from "./animation";
import { ClockPanel } from "./clock";
import { Controls } from "./controls";
import { InputPanel } from "./inputs";
import { Filling } from "./fill";
import { Inspector } from "./inspector";
import { legend } from "./legend";
import { OutputPanel } from "./outputs";
import { Schematic } from "./schematic";
import { Spacetime } from "./spacetime";
import { Stage } from "./stage";
import { StateView } from "./state_view";
import type { LiveSwarm } from "./swarm";
import { Timeline } from "./timeline";
import { TruthView } from "./truth_view";
import { Waveform } from "./waveform";

export class SwarmViews {
  readonly host = element("div", { class: "swarm" });
  readonly controls: Controls;
  readonly stage: Stage;
  readonly #animation: Animation;
  readonly #legend = element("div", { class: "legends" });

  constructor(
    private readonly swarm: LiveSwarm,
    head: HTMLElement,
  ) {
    this.#animation = new Animation(swarm);
    const wake = (): void => this.#animation.wake();
    const timeline = new Timeline();
    const [inputs, outputs] = [new InputPanel(swarm), new OutputPanel(swarm)];
    const truth = new TruthView(swarm);
    const state = new StateView(swarm);
    const filling = new Filling(this.host);
    this.stage = new Stage(swarm, wake);
    const robots = filling.button("stage", this.stage.pane.host, "The robots");
    this.controls = new Controls(swarm, robots);
    const inspector = new Inspector(swarm);
    const schematic = new Schematic(swarm);
    const [waveform, spacetime] = [new Waveform(swarm, timeline, wake), new Spacetime(swarm, timeline, wake)];
    const clock = new ClockPanel(swarm);
    const zoom = [
      iconButton("more", "Show fewer cycles", () => timeline.zoomBy(1)),
      iconButton("less", "Show more cycles", () => timeline.zoomBy(-1)),
    ];
    const diagrams = [
      new Framed("Circuit", schematic.host, [
        schematic.crumbs,
        ...schematic.tools,
        filling.button("schematic", schematic.host, "The gates"),
      ]),
      new Framed("Waveforms", waveform.pane.host, [
        waveform.toggle,
        ...zoom,
        filling.button("waveform", waveform.pane.host, "The waveforms"),
      ]),
      new Framed("Paths", spacetime.pane.host, [filling.button("spacetime", spacetime.pane.host, "The paths")], false),
    ];
    const toggles = [...diagrams.map(({ toggle }) => toggle), truth.toggle, state.toggle];
    this.host.append(
      head,
      element("div", { class: "ports" }, inputs.host, clock.host, outputs.host),
      this.controls.host,
      element("div", { class: "scene" }, this.stage.pane.host, inspector.host, truth.host, state.host),
      element("div", { class: "inspector" }, inspector.line, ...toggles),
      element("div", { class: "diagrams" }, ...diagrams.map(({ host }) => host)),
      this.#legend,
    );
    for (const view of [inputs, outputs, state, this.stage, inspector, schematic, waveform, spacetime]) {
      this.#animation.add(view);
    }
    this.#follow(wake);
  }

  wake(): void {
    this.#animation.wake();
  }

  #follow(wake: () => void): void {
    const { swarm } = this;
    swarm.definition.on(definition => {
      const looks = (definition?.looks ?? []).map(look => ({ look, name: MATERIALS[look.name] ?? look.name }));
      fill(this.#legend, legend(looks, definition?.waves?.threads ?? 1));
    });
    swarm.selection.pointed.on(wake);
    swarm.selection.followed.on(wake);
    swarm.definition.on(wake);
    colors.on(wake);
  }
}

export function summaryOf({ robots, hold, waves }: ShownSwarm): string {
  const count = `${robots.length} ${robots.length === 1 ? "robot" : "robots"}`;
  if (waves !== null) {
    const machines = waves.threads === 1 ? "one thread" : `${waves.threads} threads at once`;
    const step = `${waves.step} ${waves.step === 1 ? "cycle" : "cycles"}`;
    return `${count}, a step of ${step}, ${machines}`;
  }
  return `${count}, settles within ${hold} ${hold === 1 ? "cycle" : "cycles"}`;
}

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

/** A diagram with its name and its tools above it, and a button that shows and hides it. */
class Framed {
  readonly host: HTMLElement;
  readonly toggle: HTMLButtonElement;

  constructor(title: string, pane: HTMLElement, tools: HTMLElement[], isShown = true) {
    const name = `diagram-${title.toLowerCase()}`;
    const show = (shown: boolean): void => {
      this.host.hidden = !shown;
      this.toggle.setAttribute("aria-pressed", String(shown));
    };
    const change = (): void => {
      show(this.host.hidden);
      remember(name, !this.host.hidden);
    };
    this.host = element(
      "section",
      { class: "framed" },
      element("header", {}, element("h3", {}, title), ...tools),
      pane,
    );
    this.toggle = button(title, change, { "data-do": name });
    show(recall<boolean>(name) ?? isShown);
  }
}
