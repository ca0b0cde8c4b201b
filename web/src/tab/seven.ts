// Bytes as text of a document in UTF-8: seven bits a letter, so that the text is a seventh longer, and not a third as in
// base64. A document changes zeros and carriage returns and looks for `<`, so these are not among the letters: such seven
// bits and the next seven are one letter of two bytes.

const FORBIDDEN = [0, 0x0d, 0x3c];
/** The first letter of two bytes in UTF-8. */
const DOUBLE = 0x80;

export function textOf(bytes: Uint8Array): string {
  const parts: number[] = [];
  for (let bit = 0; bit < 8 * bytes.length; bit += 7) {
    const [at, shift] = [bit >> 3, bit & 7];
    const both = ((bytes[at] ?? 0) << 8) | (bytes[at + 1] ?? 0);
    parts.push((both >> (9 - shift)) & 127);
  }
  const letters: string[] = [];
  for (let i = 0; i < parts.length; i++) {
    const forbidden = FORBIDDEN.indexOf(parts[i] as number);
    letters.push(
      String.fromCharCode(forbidden < 0 ? (parts[i] as number) : DOUBLE + ((forbidden << 7) | (parts[++i] ?? 0))),
    );
  }
  return `${bytes.length};${letters.join("")}`;
}

export function bytesOf(text: string): Uint8Array<ArrayBuffer> {
  const first = text.indexOf(";") + 1;
  const bytes = new Uint8Array(Number(text.slice(0, first - 1)));
  let [at, sum, bits] = [0, 0, 0];
  const add = (seven: number): void => {
    sum = ((sum << 7) | seven) & 0x3fff;
    bits += 7;
    if (bits >= 8) {
      bits -= 8;
      // What is beyond the end is dropped.
      bytes[at++] = sum >> bits;
    }
  };
  for (let i = first; i < text.length; i++) {
    const letter = text.charCodeAt(i);
    if (letter < DOUBLE) {
      add(letter);
    } else {
      add(FORBIDDEN[(letter - DOUBLE) >> 7] ?? 0);
      add((letter - DOUBLE) & 127);
    }
  }
  return bytes;
}
