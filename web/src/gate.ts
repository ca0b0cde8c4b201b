// The functions of two and three stimuli that a robot can compute, by the directions in which it walks.

/** All patterns of two or three stimuli, 4 or 8, in the order of behaviors and gaits. */
export function patterns(count: number): string[] {
  return Array.from({ length: count }, (_, i) => i.toString(2).padStart(Math.log2(count), "0"));
}

/** All functions of two stimuli, and those of three that have a usual name. */
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
  ["LLLLLLLL", "zero3", "always 0"],
  ["RRRRRRRR", "one3", "always 1"],
  ["LLLLLLLR", "and3", "a AND b AND c"],
  ["RRRRRRRL", "nand3", "NOT (a AND b AND c)"],
  ["LRRRRRRR", "or3", "a OR b OR c"],
  ["RLLLLLLL", "nor3", "NOT (a OR b OR c)"],
  ["LRRLRLLR", "xor3", "a XOR b XOR c"],
  ["RLLRLRRL", "xnor3", "NOT (a XOR b XOR c)"],
  ["LLLRLRRR", "maj", "majority of a, b, c"],
  ["RRRLRLLL", "minority", "minority of a, b, c"],
  ["LRLRLLRR", "mux", "a ? b : c"],
  ["RLRLRRLL", "muxi", "NOT (a ? b : c)"],
  ["LRLRLRRR", "and_or", "(a AND b) OR c"],
  ["RLRLRLLL", "and_or_invert", "NOT ((a AND b) OR c)"],
  ["LLLRLRLR", "or_and", "(a OR b) AND c"],
  ["RRRLRLRL", "or_and_invert", "NOT ((a OR b) AND c)"],
  ["LRRLRLLL", "one_hot", "exactly one of a, b, c"],
  ["RLLLLLLR", "all_equal", "a, b, c all equal"],
  ["LRRRRRRL", "gamble", "a, b, c not all equal"],
];

export function gateName(name: string | null): string {
  return NAMES.find(([, id]) => id === name)?.[2] ?? name ?? "no gate";
}

/** The outputs of a function, for the patterns in order; null if it is unknown. */
export function truthTable(name: string | null): number[] | null {
  const bits = /^f3_([0-9a-f]{2})$/.exec(name ?? "")?.[1];
  const letters = bits === undefined ? NAMES.find(([, id]) => id === name)?.[0] : lettersOf(parseInt(bits, 16), 8);
  return letters === undefined ? null : outputsOf(letters);
}

/** The function of a behavior such as `RRRL`, or null if it has no usual name. */
export function gateOf(letters: string): string | null {
  return NAMES.find(([behavior]) => behavior === letters)?.[1] ?? null;
}

/** The behavior with a number, which has a bit for each pattern, that of the first pattern lowest. */
export function lettersOf(number: number, count: number): string {
  return Array.from({ length: count }, (_, bit) => ((number >> bit) & 1 ? "R" : "L")).join("");
}

export function outputsOf(letters: string): number[] {
  return [...letters].map(letter => (letter === "R" ? 1 : 0));
}

export const GATES = NAMES.map(([behavior, id, name]) => ({ behavior, id, name }));
