// A line that says what is pointed at, and a table about the robot that is followed.

import { button, element, factList, fill } from "../element";
import { gateName, patterns, truthTable } from "../gate";
import type { SwarmRobot } from "../protocol";
import type { View } from "./animation";
import type { LiveSwarm } from "./swarm";

const HINT = "Point at a robot or a net to mark it in all views. Click a robot to follow it.";

export class Inspector implements View {
  readonly host = element("div", { class: "facts", hidden: true });
  readonly line = element("p", { class: "line" });

  constructor(private readonly swarm: LiveSwarm) {
    swarm.definition.on(() => this.#show());
    swarm.selection.pointed.on(() => this.#show());
    swarm.selection.followed.on(() => this.#show());
    this.#show();
  }

  draw(): void {
    if (this.swarm.selection.pointed.value !== null) {
      this.#show();
    }
  }

  #show(): void {
    const { pointed, followed } = this.swarm.selection;
    const robot = followed.value === null ? null : (this.swarm.definition.value?.robots[followed.value] ?? null);
    this.#showFacts(robot);
    const text = pointed.value === null ? this.#rest() : this.#describe();
    if (this.line.textContent !== text) {
      this.line.textContent = text;
    }
  }

  #rest(): string {
    const definition = this.swarm.definition.value;
    return this.swarm.stopped.value ?? (definition === null ? "" : HINT);
  }

  #describe(): string {
    const source = this.swarm.selection.pointed.value;
    const definition = this.swarm.definition.value;
    if (source === null || definition === null) {
      return "";
    }
    const value = this.swarm.value(source);
    const name = this.swarm.nameOf(source);
    if (!("robot" in source)) {
      return `input ${name} is ${value ?? "not known yet"}`;
    }
    const robot = definition.robots[source.robot] as SwarmRobot;
    const senses = robot.senses
      .map(sense => `${this.swarm.nameOf(sense)} = ${this.swarm.value(sense) ?? "?"}`)
      .join(", ");
    const walk = value === null ? "has not walked yet" : value === 1 ? "walks right: 1" : "walks left: 0";
    const thread = this.swarm.thread(source);
    const wave = thread === null ? "" : ` with a wave of thread ${thread + 1}`;
    return `${name}: ${gateName(robot.function)} (${robot.robot})${wave} senses ${senses} and ${walk}`;
  }

  #showFacts(robot: SwarmRobot | null): void {
    const shown = this.host.dataset["net"] ?? null;
    if (shown === (robot?.net ?? null)) {
      return;
    }
    this.host.hidden = robot === null;
    if (robot === null) {
      delete this.host.dataset["net"];
      this.host.replaceChildren();
      return;
    }
    this.host.dataset["net"] = robot.net;
    fill(
      this.host,
      button("Show all robots", () => this.swarm.selection.followed.set(null), { "data-do": "all" }),
      element("h3", {}, robot.named ? `${robot.label} = ${gateName(robot.function)}` : gateName(robot.function)),
      truthTableElement(robot.function),
      factList(robot.about),
    );
  }
}

/** The outputs of a gate for all patterns of its stimuli: the first one goes down, the others to the right. */
export function truthTableElement(name: string | null, outputs = truthTable(name)): HTMLElement {
  const all = patterns(outputs?.length ?? 4);
  const columns = all.slice(0, all.length / 2).map(pattern => pattern.slice(1));
  const cell = (pattern: string, index: number): HTMLElement => {
    const value = outputs?.[index];
    const text = value === undefined ? "·" : String(value);
    const label = `${pattern} gives ${value ?? "neither"}`;
    return element("td", { "data-value": value ?? "", title: label, "aria-label": label }, text);
  };
  const cells = all.map(cell);
  const head = (text: string): HTMLElement => element("th", { scope: "col" }, text);
  return element(
    "table",
    { class: "truth", "aria-label": `Truth table of ${gateName(name)}` },
    element("tr", {}, element("th", {}, columns.length > 2 ? "a\\bc" : "a\\b"), ...columns.map(head)),
    element("tr", {}, element("th", { scope: "row" }, "0"), ...cells.slice(0, columns.length)),
    element("tr", {}, element("th", { scope: "row" }, "1"), ...cells.slice(columns.length)),
  );
}
