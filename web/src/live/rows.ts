// The rows of the waveform: inputs, outputs, registers by name, and the robots if they are asked for.

import { offsetOf } from "../ports";
import type { StimulusSource, Column, ShownSwarm } from "../protocol";
import { sameSource } from "../selection";
import type { Valued } from "./numbers";

export interface WaveRow {
  name: string;
  group: "input" | "output" | "register" | "robot";
  /** The most significant bit first; more than one is a bus. */
  sources: StimulusSource[];
  valued: Valued;
}

/** What of a swarm is shown: the robots of the part that is open, null are all, and those that were asked for. */
export interface Wanted {
  opened: number[] | null;
  robots: "all" | number[];
}

export function waveRows(swarm: ShownSwarm, { opened, robots }: Wanted): WaveRow[] {
  const ports = (ports: Column[], group: WaveRow["group"], source: (bit: number) => StimulusSource): WaveRow[] =>
    ports.map(port => {
      const start = offsetOf(ports, port);
      const sources = Array.from({ length: port.width }, (_, i) => source(start + i));
      return { name: port.name, group, sources, valued: port };
    });
  const shown = (bit: number): StimulusSource => swarm.shown[bit] ?? { constant: false };
  const outputs = ports(swarm.outputs, "output", shown);
  const isSame = (a: StimulusSource[], b: StimulusSource[]): boolean =>
    a.length === b.length && a.every((source, i) => sameSource(source, b[i] ?? null));
  const isOpen = (robot: number): boolean => opened === null || opened.includes(robot);
  const registers = swarm.registers
    .filter(register => register.robots.some(isOpen))
    .map(({ name, robots: bits }): WaveRow => {
      const sources = bits.map(robot => ({ robot }));
      return { name, group: "register", sources, valued: { width: bits.length } };
    })
    .filter(({ sources }) => !outputs.some(output => isSame(output.sources, sources)));
  const lamps = new Set(outputs.filter(({ sources }) => sources.length === 1).map(({ name }) => name));
  // A robot that drives an output of the same name is shown there.
  const single = swarm.robots.flatMap(({ net, label }, robot): WaveRow[] => {
    const isWanted = robots === "all" ? isOpen(robot) && !lamps.has(net) : robots.includes(robot);
    return isWanted ? [{ name: label, group: "robot", sources: [{ robot }], valued: { width: 1 } }] : [];
  });
  return [...ports(swarm.inputs, "input", input => ({ input })), ...outputs, ...registers, ...single];
}
