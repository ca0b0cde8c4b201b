// What a lesson can know of the page. Checks are made from this alone.

import type { LiveSwarm } from "../live/swarm";
import type { Program } from "../program";
import { toNumber } from "../ports";
import type { Column, WrittenProgram } from "../protocol";
import type { Design } from "../robots/designer";
import type { Search } from "../robots/evolution";
import type { ClaimState } from "../tests/claims";
import type { TestState } from "../tests/panel";

export interface Situation {
  path: string;
  /** The program as it is written; null while it is being checked. */
  written: WrittenProgram | null;
  /** Whether the rest is about this text. */
  isChecked: boolean;
  errors: number;
  problem: string | null;
  circuits: number;
  tests: number;
  passed: number;
  failed: number;
  /** Why the program fails each hidden test that has run, null if it passes. */
  hidden: ReadonlyMap<string, string | null>;
  /** The claims of the program, those of which all is proved, and those of which a property is refuted. */
  claims: number;
  proved: number;
  refuted: number;
  /** The circuit whose swarm is shown, and the gates that its robots are; none while they are not those of the text. */
  circuit: string | null;
  robots: string[];
  /** The gates of the circuit as it is written, and the names of its outputs. */
  gates: number;
  outputs: string[];
  /** The threads of a wave machine; 0 if it is none. */
  threads: number;
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
  tests: { states: { value: Map<number, TestState> }; claims: { states: { value: Map<number, ClaimState> } } };
  hidden: { failures: ReadonlyMap<string, string | null> };
  robots: { designer: { design: { value: Design } }; evolution: { search: { value: Search } } };
}

export function situationOf({ program, swarm, tests, robots, hidden }: Parts): Situation {
  // What is known of a text says nothing about the next one.
  const checked = program.isChecked ? program.checked.value : null;
  // The log of another program's swarm says nothing about this one.
  const isShown = program.shown === program.path.value;
  const isCurrent = isShown && program.isChecked && program.stage.value.state === "ready";
  const definition = isCurrent ? swarm.definition.value : null;
  const done = [...tests.states.value.values()].filter(state => state.state === "done");
  const passed = done.filter(state => state.results.every(verdict => verdict.passed)).length;
  const decided = [...tests.claims.states.value.values()].filter(state => state.state === "done");
  const proved = decided.filter(({ properties }) => properties.every(({ verdict }) => verdict === "proved"));
  const refuted = decided.filter(({ properties }) => properties.some(({ verdict }) => verdict === "refuted"));
  return {
    path: program.path.value,
    written: checked?.written ?? null,
    isChecked: checked !== null,
    errors: checked?.errors ?? 0,
    problem: checked?.diagnostics.find(({ severity }) => severity === "error")?.message ?? null,
    circuits: checked?.circuits.length ?? 0,
    tests: checked?.tests.length ?? 0,
    passed,
    failed: checked === null ? 0 : done.length - passed,
    hidden: checked === null ? new Map() : hidden.failures,
    claims: checked?.claims.length ?? 0,
    proved: checked === null ? 0 : proved.length,
    refuted: checked === null ? 0 : refuted.length,
    circuit: definition?.circuit ?? null,
    robots: definition?.robots.map(robot => robot.function) ?? [],
    gates: definition?.gates ?? 0,
    outputs: (isShown ? swarm.definition.value : null)?.outputs.map(({ name }) => name) ?? [],
    threads: definition?.waves?.threads ?? 0,
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

function valueAmong(ports: Column[], bits: Uint8Array, name: string): number | null {
  let start = 0;
  for (const port of ports) {
    if (port.name === name) {
      return Number(toNumber(bits.subarray(start, start + port.width)));
    }
    start += port.width;
  }
  return null;
}
