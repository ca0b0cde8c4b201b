// What a lesson can know of the page. Checks are made from this alone.

import type { LiveSwarm } from "../live/swarm";
import type { Program } from "../program";
import { toNumber } from "../ports";
import type { PortEntry } from "../protocol";
import type { Design } from "../robots/designer";
import type { Search } from "../robots/evolution";
import type { TestState } from "../tests/panel";

export interface Situation {
  path: string;
  text: string;
  errors: number;
  circuits: number;
  tests: number;
  passed: number;
  /** The cycles done. */
  now: number;
  /** Cycles after which every change has settled. */
  hold: number;
  /** The number at a port in a cycle; null if there is none. */
  port: (name: string, cycle: number) => number | null;
  design: Design;
  search: Search;
}

interface Parts {
  program: Program;
  swarm: LiveSwarm;
  tests: { states: { value: Map<number, TestState> } };
  robots: { designer: { design: { value: Design } }; evolution: { search: { value: Search } } };
}

export function situationOf({ program, swarm, tests, robots }: Parts): Situation {
  // What is known of a text says nothing about the next one.
  const checked = program.isChecked ? program.checked.value : null;
  // The log of another program's swarm says nothing about this one.
  const isShown = program.shown === program.path.value;
  const states = [...tests.states.value.values()];
  return {
    path: program.path.value,
    text: program.text,
    errors: checked?.errors ?? 0,
    circuits: checked?.circuits.length ?? 0,
    tests: checked?.tests.length ?? 0,
    passed: states.filter(state => state.state === "done" && state.results.every(verdict => verdict.passed)).length,
    now: isShown ? swarm.playback.cycle : 0,
    hold: swarm.definition.value?.hold ?? 4,
    port: (name, cycle) => (isShown ? portValue(swarm, name, cycle) : null),
    design: robots.designer.design.value,
    search: robots.evolution.search.value,
  };
}

function portValue(swarm: LiveSwarm, name: string, cycle: number): number | null {
  const definition = swarm.definition.value;
  const logged = swarm.log.at(cycle);
  if (definition === null || logged === undefined) {
    return null;
  }
  return valueAmong(definition.inputs, logged.inputs, name) ?? valueAmong(definition.outputs, logged.outputs, name);
}

function valueAmong(ports: PortEntry[], bits: Uint8Array, name: string): number | null {
  let start = 0;
  for (const port of ports) {
    if (port.name === name) {
      return Number(toNumber(bits.subarray(start, start + port.width)));
    }
    start += port.width;
  }
  return null;
}
