// The page on paper: the program, its circuit and its results, without what one can press.

import { element, fill } from "./element";
import { wholeOf } from "./live/schematic_parts";
import type { LiveSwarm } from "./live/swarm";
import { summaryOf } from "./live/views";
import { bitsOf } from "./ports";
import type { Program } from "./program";
import type { TestsPanel } from "./tests/panel";
import { verdictTable } from "./tests/verdict";

export function paper(program: Program, swarm: LiveSwarm, tests: TestsPanel): HTMLElement {
  const host = element("section", { class: "paper", "aria-hidden": "true" });
  addEventListener("beforeprint", () =>
    fill(
      host,
      element("h1", {}, program.path.value),
      program.unsaved.value && element("p", {}, "not saved"),
      numbered(program.text),
      ...(program.shown === program.path.value ? circuit(swarm) : []),
      ...results(program, tests),
    ),
  );
  addEventListener("afterprint", () => fill(host));
  return host;
}

function numbered(text: string): HTMLElement {
  const lines = text.replace(/\n$/, "").split("\n");
  return element("ol", { class: "program" }, ...lines.map(line => element("li", {}, element("code", {}, line || " "))));
}

function circuit(swarm: LiveSwarm): HTMLElement[] {
  const definition = swarm.definition.value;
  if (definition === null) {
    return [];
  }
  const drawing = element("img", {
    class: "drawing",
    alt: "The schematic",
    src: `data:image/svg+xml;charset=utf-8,${encodeURIComponent(wholeOf(definition.schematic))}`,
  });
  const cycle = swarm.playback.cycle;
  const logged = swarm.log.at(cycle);
  const values = (ports: typeof definition.inputs, bits: Uint8Array | undefined): string =>
    bitsOf(ports)
      .map(({ name, index }) => `${name} = ${bits?.[index] ?? "?"}`)
      .join(", ");
  return [
    element("h2", {}, definition.circuit),
    element("p", {}, summaryOf(definition)),
    drawing,
    element(
      "p",
      { class: "values" },
      `Cycle ${cycle}: ${values(definition.inputs, logged?.inputs)}; ${values(definition.outputs, logged?.outputs)}`,
    ),
  ];
}

function results(program: Program, tests: TestsPanel): HTMLElement[] {
  const leads = { line: () => {}, moment: null };
  const one = ({ circuit, title, index }: { circuit: string; title: string; index: number }): HTMLElement => {
    const state = tests.states.value.get(index);
    const done = state?.state === "done" ? state : null;
    const passed = done?.results.every(({ passed }) => passed);
    const level = done?.level === "physics" ? "in physics" : "as logic";
    const said = done === null ? "not run" : `${passed ? "✓ passes" : "✗ fails"} ${level}`;
    return element(
      "article",
      {},
      element("h3", {}, `${circuit} “${title}”: ${said}`),
      ...(done?.results ?? []).map(verdict => verdictTable(verdict, leads)),
    );
  };
  const listed = program.checked.value?.tests ?? [];
  return listed.length === 0 ? [] : [element("h2", {}, "Tests"), ...listed.map(one)];
}
