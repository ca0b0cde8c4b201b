// What an environment does while its test gives the inputs of a swarm: its screen, and the words of its memories.

import type { ShownMemory } from "../protocol";

/** A row of a memory: a word, or as many words of a bit as a number has. */
export interface MemoryRow {
  at: number;
  value: bigint;
  width: number;
  /** Whether a word of it is read in the cycle, or was written in it. */
  isRead: boolean;
  isWritten: boolean;
}

/** Words of one bit are shown as numbers of so many, the lowest address the lowest bit. */
const PACKED = 32;
const MOST_ROWS = 64;

/** The last of some things that began before a cycle; cycles count from 1, and 0 is the start. */
function lastBegun<T extends [begin: number, ...rest: unknown[]]>(all: T[], cycle: number): T | undefined {
  return all.filter(([begin]) => begin < Math.max(cycle, 1)).at(-1);
}

export function screenAt(screen: [begin: number, text: string][], cycle: number): string {
  return screen
    .filter(([begin]) => begin < cycle)
    .map(([, text]) => text)
    .join("");
}

export function readAt({ reads }: ShownMemory, cycle: number): number[] {
  return reads.flatMap(places => lastBegun(places, cycle)?.[1] ?? []);
}

export function wordAt({ words, writes }: ShownMemory, address: number, cycle: number): bigint {
  const written = writes.filter(([begin, place]) => begin < cycle && place === address).at(-1);
  return BigInt(`0x${written?.[2] ?? words[address] ?? "0"}`);
}

/** The rows of a memory that are of use: those that it begins with, has been given, or reads; near what is read. */
export function memoryRows(memory: ShownMemory, cycle: number): { rows: MemoryRow[]; left: number } {
  const packed = memory.width === 1 ? PACKED : 1;
  const rowOf = (address: number): number => Math.floor(address / packed);
  const written = memory.writes.filter(([begin]) => begin < cycle);
  const last = written.at(-1)?.[0];
  const read = new Set(readAt(memory, cycle).map(rowOf));
  const fresh = new Set(written.filter(([begin]) => begin === last).map(([, address]) => rowOf(address)));
  const used = new Set([...memory.words.keys(), ...written.map(([, address]) => address)].map(rowOf));
  const all = [...new Set([...used, ...read])].filter(at => at * packed < memory.size).sort((a, b) => a - b);
  const middle = Math.max(0, all.indexOf(Math.min(...read)));
  const first = Math.max(0, Math.min(middle - MOST_ROWS / 2, all.length - MOST_ROWS));
  const rows = all.slice(first, first + MOST_ROWS).map((at): MemoryRow => {
    const bits = Array.from({ length: packed }, (_, bit) => wordAt(memory, at * packed + bit, cycle) << BigInt(bit));
    const value = bits.reduce((sum, bit) => sum | bit, 0n);
    return { at, value, width: memory.width * packed, isRead: read.has(at), isWritten: fresh.has(at) };
  });
  return { rows, left: all.length - rows.length };
}
