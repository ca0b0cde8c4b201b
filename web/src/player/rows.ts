// Runs the rows of tests through a swarm at the level of logic.

import type { ExportedTest } from "../protocol";
import type { Machine } from "./machine";

/** What became of a row. */
export interface RowEnd {
  /** The bits of the outputs. */
  observed: string;
  passed: boolean;
}

/** Holds the inputs of each row until everything has settled, and compares the outputs. */
export function runRows(machine: Machine, test: ExportedTest): RowEnd[] {
  const logic = machine.logic();
  const { hold, start, shown } = machine.swarm;
  return test.rows.map(({ inputs, expected }, i) => {
    const bits = [...inputs].map(Number);
    for (let left = hold + (i === 0 ? start : 0); left > 0; left--) {
      logic.step(bits);
    }
    const observed = [...logic.values(shown, bits)].join("");
    return { observed, passed: [...expected].every((bit, at) => bit === "-" || bit === observed[at]) };
  });
}
