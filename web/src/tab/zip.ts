// Zip archives of text files, without a library: browsers can deflate. What is read may be broken or hostile.

import { pack, unpack } from "../share/packed";
import type { KeptFiles } from "./files";

/** Why an archive cannot be read, for the user. */
export class ZipError extends Error {}

/** The most bytes of an archive, of a file in it, and of all of them; and the most files. */
const MOST_ARCHIVE = 20_000_000;
export const MOST_FILE = 1_000_000;
const MOST_BYTES = 20_000_000;
const MOST_FILES = 1000;

const LOCAL = 0x04034b50;
const CENTRAL = 0x02014b50;
const END = 0x06054b50;
const LOCAL_SIZE = 30;
const CENTRAL_SIZE = 46;
const END_SIZE = 22;
/** The longest comment after the directory. */
const MOST_COMMENT = 0xffff;
const STORED = 0;
const DEFLATED = 8;
const UTF8 = 0x0800;
const ENCRYPTED = 1;
/** The first of January 1980: the same files give the same archive. */
const DATE = 0x0021;

/** Makes an archive. */
export async function zip(files: KeptFiles): Promise<Uint8Array> {
  const parts: Uint8Array[] = [];
  const directory: Uint8Array[] = [];
  let offset = 0;
  for (const [path, text] of files) {
    const [name, bytes] = [encoded(path), encoded(text)];
    const deflated = await pack(bytes);
    const isSmaller = deflated.length < bytes.length;
    const data = isSmaller ? deflated : bytes;
    const common: Field[] = [
      [2, 20],
      [2, UTF8],
      [2, isSmaller ? DEFLATED : STORED],
      [2, 0],
      [2, DATE],
      [4, crc32(bytes)],
      [4, data.length],
      [4, bytes.length],
      [2, name.length],
      [2, 0],
    ];
    const local = fields([[4, LOCAL], ...common]);
    const attributes: Field[] = [
      [2, 0],
      [2, 0],
      [2, 0],
      [4, 0],
      [4, offset],
    ];
    parts.push(local, name, data);
    directory.push(fields([[4, CENTRAL], [2, 20], ...common, ...attributes]), name);
    offset += local.length + name.length + data.length;
  }
  const size = directory.reduce((sum, part) => sum + part.length, 0);
  const end: Field[] = [
    [4, END],
    [4, 0],
    [2, files.length],
    [2, files.length],
    [4, size],
    [4, offset],
    [2, 0],
  ];
  return joined([...parts, ...directory, fields(end)]);
}

/** What an archive has: its text files, and the paths of what is no text. */
export interface Unzipped {
  files: KeptFiles;
  leftOut: string[];
}

/** Reads an archive. What a system hides, such as `.git`, is passed over. */
export async function unzip(bytes: Uint8Array): Promise<Unzipped> {
  if (bytes.length > MOST_ARCHIVE) {
    throw new ZipError(`the archive is larger than ${megabytes(MOST_ARCHIVE)}`);
  }
  const read: Unzipped = { files: [], leftOut: [] };
  let all = 0;
  for (const entry of entries(bytes)) {
    const contents = await contentsOf(bytes, entry);
    all += contents.length;
    if (all > MOST_BYTES) {
      throw new ZipError(`the files are larger than ${megabytes(MOST_BYTES)} together`);
    }
    const text = decoded(contents);
    if (text === null) {
      read.leftOut.push(entry.path);
    } else {
      read.files.push([entry.path, text]);
    }
  }
  return read;
}

interface Entry {
  path: string;
  method: number;
  crc: number;
  packed: number;
  size: number;
  offset: number;
}

/** The files that the directory at the end names. */
function entries(bytes: Uint8Array): Entry[] {
  const view = viewOf(bytes);
  const end = endOf(view);
  if (end === null) {
    throw new ZipError("this is not a zip archive, or its end is missing");
  }
  const count = view.getUint16(end + 10, true);
  let at = view.getUint32(end + 16, true);
  if (count > MOST_FILES || at === 0xffff_ffff) {
    throw new ZipError(`the archive has more than ${MOST_FILES} files`);
  }
  const found = new Map<string, Entry>();
  for (let i = 0; i < count; i++) {
    if (at + CENTRAL_SIZE > bytes.length || view.getUint32(at, true) !== CENTRAL) {
      throw damaged();
    }
    const [flags, nameLength] = [view.getUint16(at + 8, true), view.getUint16(at + 28, true)];
    const name = decoded(bytes.subarray(at + CENTRAL_SIZE, at + CENTRAL_SIZE + nameLength));
    if (name === null) {
      throw new ZipError("the names of the files are not in UTF-8; pack them with another program");
    }
    const path = pathOf(name);
    if (path !== null) {
      if ((flags & ENCRYPTED) !== 0) {
        throw new ZipError(`${path} is encrypted`);
      }
      if (found.has(path)) {
        throw new ZipError(`the archive has two files ${path}`);
      }
      found.set(path, {
        path,
        method: view.getUint16(at + 10, true),
        crc: view.getUint32(at + 16, true),
        packed: view.getUint32(at + 20, true),
        size: view.getUint32(at + 24, true),
        offset: view.getUint32(at + 42, true),
      });
    }
    at += CENTRAL_SIZE + nameLength + view.getUint16(at + 30, true) + view.getUint16(at + 32, true);
  }
  return [...found.values()];
}

/** Where the record at the end of an archive is. */
function endOf(view: DataView): number | null {
  const last = view.byteLength - END_SIZE;
  for (let at = last; at >= Math.max(0, last - MOST_COMMENT); at--) {
    if (view.getUint32(at, true) === END) {
      return at;
    }
  }
  return null;
}

/** A path within the folder; null for a folder, and for what systems hide. */
function pathOf(name: string): string | null {
  const parts = name.replaceAll("\\", "/").split("/");
  if (parts.at(-1) === "" || parts.some(part => (part.startsWith(".") && part !== "..") || part === "__MACOSX")) {
    return null;
  }
  if (parts.some(part => part === "" || part === ".." || /[\u0000-\u001f\u007f]/.test(part))) {
    throw new ZipError(`the archive has a file outside of its folder: ${name}`);
  }
  return parts.join("/");
}

async function contentsOf(bytes: Uint8Array, entry: Entry): Promise<Uint8Array> {
  const { path, method, crc, packed, size, offset } = entry;
  if (size > MOST_FILE) {
    throw new ZipError(`${path} is larger than ${megabytes(MOST_FILE)}`);
  }
  const view = viewOf(bytes);
  if (offset + LOCAL_SIZE > bytes.length || view.getUint32(offset, true) !== LOCAL) {
    throw damaged();
  }
  const start = offset + LOCAL_SIZE + view.getUint16(offset + 26, true) + view.getUint16(offset + 28, true);
  if (start + packed > bytes.length) {
    throw damaged();
  }
  const data = bytes.subarray(start, start + packed);
  if (method !== STORED && method !== DEFLATED) {
    throw new ZipError(`${path} is packed in a way that is not known here; pack it with “deflate”`);
  }
  // More than was said is not unpacked.
  const contents = method === STORED ? data : await unpack(data, size).catch(() => null);
  if (contents === null || contents.length !== size || crc32(contents) !== crc) {
    throw damaged();
  }
  return contents;
}

function damaged(): ZipError {
  return new ZipError("the archive is damaged: a part of it may be missing");
}

type Field = [bytes: 2 | 4, value: number];

function fields(all: Field[]): Uint8Array {
  const bytes = new Uint8Array(all.reduce((sum, [size]) => sum + size, 0));
  const view = viewOf(bytes);
  let at = 0;
  for (const [size, value] of all) {
    if (size === 2) {
      view.setUint16(at, value, true);
    } else {
      view.setUint32(at, value, true);
    }
    at += size;
  }
  return bytes;
}

function joined(parts: Uint8Array[]): Uint8Array {
  const whole = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) {
    whole.set(part, at);
    at += part.length;
  }
  return whole;
}

function viewOf(bytes: Uint8Array): DataView {
  return new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
}

function encoded(text: string): Uint8Array {
  return new TextEncoder().encode(text);
}

/** A text; null if it is none. */
export function decoded(bytes: Uint8Array): string | null {
  try {
    return new TextDecoder("utf-8", { fatal: true }).decode(bytes);
  } catch {
    return null;
  }
}

const TABLE = Uint32Array.from({ length: 256 }, (_, byte) => {
  let value = byte;
  for (let bit = 0; bit < 8; bit++) {
    value = value & 1 ? 0xedb8_8320 ^ (value >>> 1) : value >>> 1;
  }
  return value;
});

function crc32(bytes: Uint8Array): number {
  let sum = 0xffff_ffff;
  for (const byte of bytes) {
    sum = (TABLE[(sum ^ byte) & 255] ?? 0) ^ (sum >>> 8);
  }
  return (sum ^ 0xffff_ffff) >>> 0;
}

function megabytes(bytes: number): string {
  return `${bytes / 1e6} MB`;
}
