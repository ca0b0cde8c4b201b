// Bytes, compressed and as letters that an address can have.

import { deflateSync, inflateSync } from "fflate";

export function pack(bytes: Uint8Array): Uint8Array {
  return deflateSync(bytes, { level: 9 });
}

/** The bytes that were packed; null if they are more than `most`. Fails if they are not whole. */
export function unpack(bytes: Uint8Array, most: number): Uint8Array | null {
  // What has no room is dropped.
  const unpacked = inflateSync(bytes, { out: new Uint8Array(most + 1) });
  return unpacked.length > most ? null : unpacked;
}

/** RFC 4648, section 5, without padding. */
export function encodeBase64Url(bytes: Uint8Array): string {
  const raw = [...bytes].map(byte => String.fromCharCode(byte)).join("");
  return btoa(raw).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

export function decodeBase64Url(text: string): Uint8Array {
  if (!/^[\w-]+$/.test(text) || text.length % 4 === 1) {
    throw new Error("not whole bytes");
  }
  return decodeBase64(text.replaceAll("-", "+").replaceAll("_", "/"));
}

export function decodeBase64(text: string): Uint8Array<ArrayBuffer> {
  return Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
}
