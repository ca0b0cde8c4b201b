// The conditions of lessons.

import type { Situation } from "./situation";

export type Check = (situation: Situation) => boolean;

export type Values = Record<string, number>;

/** The ports have these values now. */
export function shows(values: Values): Check {
  return situation => holds(situation, values, situation.now);
}

/** The ports have had these values for as long as a change needs to settle. */
export function keeps(values: Values): Check {
  return situation => {
    const start = situation.now - situation.hold;
    return (
      start >= 1 &&
      Array.from({ length: situation.hold + 1 }, (_, i) => start + i).every(cycle => holds(situation, values, cycle))
    );
  };
}

/** Each of these patterns of values has been there in the last `cycles` cycles. */
export function hasShown(patterns: Values[], cycles = 400): Check {
  return situation => {
    const start = Math.max(1, situation.now - cycles);
    const range = Array.from({ length: situation.now - start + 1 }, (_, i) => start + i);
    return patterns.every(values => range.some(cycle => holds(situation, values, cycle)));
  };
}

/** The body in the designer is this gate. */
export function designs(gate: (name: string) => boolean): Check {
  return ({ design }) => design.probe !== null && !("fault" in design.probe) && gate(design.probe.function);
}

function holds(situation: Situation, values: Values, cycle: number): boolean {
  return Object.entries(values).every(([name, value]) => situation.port(name, cycle) === value);
}
