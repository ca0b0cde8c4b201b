// The names of files that are taken away. Files of different things have different names.

import type { TakeKind } from "./protocol";

const KINDS: Record<TakeKind | "live" | "recorded" | "schematic", string> = {
  page: "report",
  gif: "film",
  png: "spacetime",
  svg: "spacetime",
  vcd: "waveforms",
  csv: "cycles",
  live: "live",
  recorded: "recorded",
  schematic: "schematic",
};

export interface Taken {
  circuit: string;
  swarm: string | null;
  what: keyof typeof KINDS;
  ending: string;
  /** The first and the last cycle that it covers, if it is about some. */
  cycles?: [number, number];
}

/** `latch-few-spacetime-13-52.svg` is the spacetime diagram of cycles 13 to 52 of the circuit as the swarm `few`. */
export function takenName({ circuit, swarm, what, ending, cycles }: Taken): string {
  const plain = (text: string): string => text.replace(/[^\p{L}\p{N}]+/gu, "_").replace(/^_+|_+$/g, "");
  const parts = [plain(circuit), ...(swarm === null ? [] : [plain(swarm)]), KINDS[what], ...(cycles ?? [])];
  return `${parts.join("-")}.${ending}`;
}
