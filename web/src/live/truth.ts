// The truth table of a circuit without state, computed from the functions of its robots.

import { truthTable } from "../gate";
import { totalWidth } from "../ports";
import type { StimulusSource, ShownSwarm } from "../protocol";

/** A row of a truth table: the bits of the inputs and of the outputs, in order. */
export interface TruthRow {
  inputs: string;
  outputs: string;
}

/** Circuits with more bits of inputs have no table: it would be too long to read. */
export const MOST_BITS = 5;

/** All rows; null if the circuit has a state, no inputs, or too many. */
export function truthRows(swarm: ShownSwarm): TruthRow[] | null {
  const width = totalWidth(swarm.inputs);
  const outputsOf = width === 0 || width > MOST_BITS ? null : logicOf(swarm);
  if (outputsOf === null) {
    return null;
  }
  return Array.from({ length: 1 << width }, (_, row) => {
    const inputs = row.toString(2).padStart(width, "0");
    return { inputs, outputs: outputsOf(inputs) };
  });
}

/** What the bits of the outputs are, by those of the inputs, once all robots have settled; null for one with a state. */
export function logicOf(swarm: ShownSwarm): ((inputs: string) => string) | null {
  const order = levelized(swarm);
  const tables = swarm.robots.map(robot => truthTable(robot.function));
  // The registers of a wave machine need no loop of robots.
  if (order === null || (swarm.waves?.clock ?? null) !== null || tables.includes(null)) {
    return null;
  }
  return inputs => {
    const bits = new Uint8Array(swarm.robots.length);
    const value = (source: StimulusSource): number => valueOf(source, inputs, bits);
    for (const robot of order) {
      const senses = swarm.robots[robot]?.senses ?? [];
      bits[robot] = tables[robot]?.[senses.reduce((pattern, source) => 2 * pattern + value(source), 0)] ?? 0;
    }
    return swarm.shown.map(value).join("");
  };
}

function valueOf(source: StimulusSource, inputs: string, robots: Uint8Array): number {
  if ("constant" in source) {
    return Number(source.constant);
  }
  return "input" in source ? Number(inputs[source.input]) : (robots[source.robot] ?? 0);
}

/** The robots, each after those that it senses; null if some of them are a loop, which is a state. */
function levelized({ robots }: ShownSwarm): number[] | null {
  const before = robots.map(({ senses }) => senses.flatMap(source => ("robot" in source ? [source.robot] : [])));
  const listeners = robots.map((): number[] => []);
  before.forEach((heard, robot) => heard.forEach(other => listeners[other]?.push(robot)));
  const missing = before.map(heard => heard.length);
  const order = [...missing.keys()].filter(robot => missing[robot] === 0);
  for (let at = 0; at < order.length; at++) {
    for (const listener of listeners[order[at] as number] ?? []) {
      if (--(missing[listener] as number) === 0) {
        order.push(listener);
      }
    }
  }
  return order.length === robots.length ? order : null;
}
