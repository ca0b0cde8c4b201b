// Bytes, compressed and as letters that an address can have.

export async function pack(bytes: Uint8Array): Promise<Uint8Array> {
  const packed = await through(bytes, new CompressionStream("deflate-raw"), Infinity);
  return packed ?? new Uint8Array();
}

/** The bytes that were packed; null if they are more than `most`. Fails if they are not whole. */
export function unpack(bytes: Uint8Array, most: number): Promise<Uint8Array | null> {
  return through(bytes, new DecompressionStream("deflate-raw"), most);
}

async function through(
  bytes: Uint8Array,
  stream: CompressionStream | DecompressionStream,
  most: number,
): Promise<Uint8Array | null> {
  const reader = new Blob([bytes as Uint8Array<ArrayBuffer>]).stream().pipeThrough(stream).getReader();
  const parts: Uint8Array[] = [];
  let size = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) {
      break;
    }
    size += value.length;
    if (size > most) {
      await reader.cancel();
      return null;
    }
    parts.push(value);
  }
  const whole = new Uint8Array(size);
  let at = 0;
  for (const part of parts) {
    whole.set(part, at);
    at += part.length;
  }
  return whole;
}

/** RFC 4648, section 5, without padding. */
export function encodeBase64Url(bytes: Uint8Array): string {
  let raw = "";
  for (const byte of bytes) {
    raw += String.fromCharCode(byte);
  }
  return btoa(raw).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

/** The bytes of such a text; null if it is none. */
export function decodeBase64Url(text: string): Uint8Array | null {
  if (!/^[\w-]+$/.test(text) || text.length % 4 === 1) {
    return null;
  }
  const raw = atob(text.replaceAll("-", "+").replaceAll("_", "/"));
  return Uint8Array.from(raw, letter => letter.charCodeAt(0));
}
