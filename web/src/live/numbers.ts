// Numbers of ports and registers as the reader wants them.

import { Observable } from "../observable";
import { recall, remember } from "../memory";

/** How numbers are written; where there are no names, these are decimal. */
export type NumberFormat = "names" | "decimal" | "hex" | "signed";

export const FORMATS: [NumberFormat, string][] = [
  ["names", "by name"],
  ["decimal", "decimal"],
  ["hex", "hexadecimal"],
  ["signed", "signed"],
];

export interface Valued {
  width: number;
  members?: [string, string][];
}

export const numberFormat = new Observable<NumberFormat>(known(recall("numbers")));
numberFormat.on(format => remember("numbers", format));

function known(format: unknown): NumberFormat {
  return FORMATS.find(([name]) => name === format)?.[0] ?? "names";
}

export function numberText(value: bigint, { width, members = [] }: Valued, format = numberFormat.value): string {
  switch (format) {
    case "names":
      return members.find(([, digits]) => BigInt(`0b${digits}`) === value)?.[0] ?? String(value);
    case "hex":
      return `0x${value.toString(16).padStart(Math.ceil(width / 4), "0")}`;
    case "signed":
      return String(BigInt.asIntN(width, value));
    default:
      return String(value);
  }
}

/**
 * The value of a text as typed: a member, a decimal number, perhaps with a sign, or a binary or hexadecimal one after
 * `0b` or `0x`; null if it is none or does not fit.
 */
export function typedNumber(text: string, { width, members = [] }: Valued): bigint | null {
  const plain = text.trim();
  const member = members.find(([name]) => name === plain);
  if (member !== undefined) {
    return BigInt(`0b${member[1]}`);
  }
  const parts = /^(-?)(\d+|0b[01]+|0x[\da-f]+)$/.exec(plain.toLowerCase());
  if (parts === null) {
    return null;
  }
  const size = BigInt(parts[2] as string);
  const fits = parts[1] === "-" ? 2n * size <= 1n << BigInt(width) : size >> BigInt(width) === 0n;
  return fits ? BigInt.asUintN(width, parts[1] === "-" ? -size : size) : null;
}
