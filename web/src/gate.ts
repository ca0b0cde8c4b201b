// The sixteen functions of two stimuli that a robot can compute, by the directions in which it walks.

/** Patterns of the two stimuli, in the order of behaviors and gaits. */
export const PATTERNS = ["00", "01", "10", "11"] as const;

const NAMES: [string, string, string][] = [
  ["LLLL", "zero", "always 0"],
  ["LLLR", "and", "a AND b"],
  ["LLRL", "a_and_notb", "a AND NOT b"],
  ["LLRR", "buf", "a"],
  ["LRLL", "nota_and_b", "NOT a AND b"],
  ["LRLR", "b", "b"],
  ["LRRL", "xor", "a XOR b"],
  ["LRRR", "or", "a OR b"],
  ["RLLL", "nor", "a NOR b"],
  ["RLLR", "xnor", "a XNOR b"],
  ["RLRL", "notb", "NOT b"],
  ["RLRR", "a_or_notb", "a OR NOT b"],
  ["RRLL", "not", "NOT a"],
  ["RRLR", "nota_or_b", "NOT a OR b"],
  ["RRRL", "nand", "a NAND b"],
  ["RRRR", "one", "always 1"],
];

/** What a function is called on the page. */
export function gateName(name: string | null): string {
  return NAMES.find(([, id]) => id === name)?.[2] ?? name ?? "no gate";
}

/** The four outputs of a function, for the patterns in order; null if it is unknown. */
export function truthTable(name: string | null): number[] | null {
  const letters = NAMES.find(([, id]) => id === name)?.[0];
  return letters === undefined ? null : outputsOf(letters);
}

/** The function of a behavior such as `RRRL`, or null where a letter is neither. */
export function gateOf(letters: string): string | null {
  return NAMES.find(([behavior]) => behavior === letters)?.[1] ?? null;
}

export function outputsOf(letters: string): number[] {
  return [...letters].map(letter => (letter === "R" ? 1 : 0));
}

/** The functions for choosing, those that need both stimuli first. */
export const GATES = NAMES.map(([behavior, id, name]) => ({ behavior, id, name }));
