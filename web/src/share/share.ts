// The program that is shown as a link, and the inputs of a link for the swarm that is compiled from it.

import type { LiveSwarm } from "../live/swarm";
import { offsetOf } from "../ports";
import type { Program } from "../program";
import type { ShownSwarm } from "../protocol";
import type { SharedProgram } from "./link";

export function shareOf(program: Program, swarm: LiveSwarm, tab: string): SharedProgram {
  const definition = program.shown === program.path.value ? swarm.definition.value : null;
  const inputs = (definition?.inputs ?? []).map((port): [string, string] => {
    const start = offsetOf(definition?.inputs ?? [], port);
    return [port.name, swarm.inputs.value.slice(start, start + port.width)];
  });
  return {
    file: program.path.value.split("/").at(-1) ?? "",
    text: program.text,
    circuit: program.choice.value?.circuit ?? null,
    swarm: program.choice.value?.swarm ?? null,
    inputs: new Map(inputs),
    tab,
  };
}

/** The bits of the inputs of a swarm as a link has them; null if it is of another circuit. */
export function sharedBits({ circuit, inputs }: SharedProgram, swarm: ShownSwarm): string | null {
  if (circuit !== swarm.circuit || inputs.size === 0) {
    return null;
  }
  return swarm.inputs
    .map(({ name, width }) => {
      const bits = inputs.get(name);
      return bits?.length === width ? bits : "0".repeat(width);
    })
    .join("");
}
