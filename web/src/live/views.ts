// The views of a swarm: its inputs and outputs, the controls, the stage and the diagrams.

import { element, fill, iconButton } from "../element";
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

  /** The views below a `head`. */
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
    this.controls = new Controls(swarm, [truth.toggle, state.toggle], [robots, fullScreen(this.host)]);
    const inspector = new Inspector(swarm);
    const schematic = new Schematic(swarm);
    schematic.tools.append(filling.button("schematic", schematic.host, "The gates"));
    const [waveform, spacetime] = [new Waveform(swarm, timeline, wake), new Spacetime(swarm, timeline, wake)];
    const clock = new ClockPanel(swarm);
    this.host.append(
      head,
      element("div", { class: "ports" }, inputs.host, clock.host, outputs.host),
      this.controls.host,
      element("div", { class: "scene" }, this.stage.pane.host, inspector.host, truth.host, state.host),
      element("div", { class: "diagrams" }, schematic.host, diagrams([waveform, spacetime], timeline, filling)),
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

/** How large a swarm is, and how long its changes take. */
export function summaryOf({ robots, hold, waves }: ShownSwarm): string {
  const count = `${robots.length} ${robots.length === 1 ? "robot" : "robots"}`;
  if (waves !== null) {
    const machines = waves.threads === 1 ? "one thread" : `${waves.threads} threads at once`;
    const step = `${waves.step} ${waves.step === 1 ? "cycle" : "cycles"}`;
    return `${count}, a step of ${step}, ${machines}`;
  }
  return `${count}, settles within ${hold} ${hold === 1 ? "cycle" : "cycles"}`;
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

function diagrams([waveform, spacetime]: [Waveform, Spacetime], timeline: Timeline, filling: Filling): HTMLElement {
  return element(
    "div",
    { class: "times" },
    element(
      "div",
      { class: "framed" },
      element(
        "div",
        { class: "zoom" },
        waveform.toggle,
        iconButton("more", "Show fewer cycles", () => timeline.zoomBy(1)),
        iconButton("less", "Show more cycles", () => timeline.zoomBy(-1)),
        filling.button("waveform", waveform.pane.host, "The waveforms"),
      ),
      waveform.pane.host,
    ),
    element(
      "div",
      { class: "framed" },
      element("div", { class: "zoom" }, filling.button("spacetime", spacetime.pane.host, "The paths")),
      spacetime.pane.host,
    ),
  );
}

/** Shows the robots with their inputs on the whole screen, and back. A phone that cannot do this has no button. */
function fullScreen(whole: HTMLElement): HTMLElement {
  const made = iconButton(
    "full",
    "Full screen",
    () => void (document.fullscreenElement === null ? whole.requestFullscreen() : document.exitFullscreen()),
    { "data-do": "full", hidden: !document.fullscreenEnabled },
  );
  document.addEventListener("fullscreenchange", () => {
    const full = document.fullscreenElement === whole;
    made.setAttribute("aria-pressed", String(full));
    made.title = full ? "Leave full screen (Esc)" : "Full screen";
  });
  return made;
}
