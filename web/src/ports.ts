// Ports as bits and as numbers. Bits are in order of the ports, the most significant bit of a port first.

import type { Column } from "./protocol";

export interface PortBit {
  port: Column;
  /** Within the port, 0 the least significant. */
  place: number;
  /** Among the bits of all ports. */
  index: number;
  /** `a`, or `a[2]` in a bus. */
  name: string;
}

export const totalWidth = (ports: Column[]): number => ports.reduce((sum, port) => sum + port.width, 0);
export const offsetOf = (ports: Column[], port: Column): number => totalWidth(ports.slice(0, ports.indexOf(port)));

export function bitsOf(ports: Column[]): PortBit[] {
  let index = 0;
  return ports.flatMap(port =>
    Array.from({ length: port.width }, (_, i) => {
      const place = port.width - 1 - i;
      return { port, place, index: index++, name: port.width === 1 ? port.name : `${port.name}[${place}]` };
    }),
  );
}

export function toNumber(bits: Iterable<number>): bigint {
  let value = 0n;
  for (const bit of bits) {
    value = 2n * value + BigInt(bit);
  }
  return value;
}

export function toBits(value: bigint, width: number): number[] {
  return Array.from({ length: width }, (_, i) => Number((value >> BigInt(width - 1 - i)) & 1n));
}

export function withBit(text: string, index: number, bit: number): string {
  return text.slice(0, index) + String(bit) + text.slice(index + 1);
}

/** The bits of inputs `after`, where ports that were among `before` keep their values. */
export function keepBits(text: string, before: Column[], after: Column[]): string {
  const kept = after.map(port => {
    const same = before.find(other => other.name === port.name && other.width === port.width);
    const start = same === undefined ? 0 : offsetOf(before, same);
    return same === undefined ? "0".repeat(port.width) : text.slice(start, start + port.width);
  });
  return kept.join("");
}
