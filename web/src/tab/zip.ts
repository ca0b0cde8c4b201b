// Zip archives. What is read may be broken or hostile.

import { strFromU8, strToU8, unzipSync, zipSync } from "fflate";

import type { Contents, KeptFiles } from "./files";

export class ZipError extends Error {}

/** The most bytes of an archive, of a file in it, and of all of them; and the most files. */
const MOST_ARCHIVE = 20_000_000;
export const MOST_FILE = 1_000_000;
const MOST_BYTES = 20_000_000;
const MOST_FILES = 1000;
/** What a name must not have: nobody could see it. */
export const INVISIBLE = /[\p{C}\p{Zl}\p{Zp}]/u;
/** The same files give the same archive. */
const DATE = new Date(1980, 0, 1);

export function zip(files: KeptFiles): Uint8Array {
  const all = files.map(([path, file]) => [path, typeof file === "string" ? strToU8(file) : file] as const);
  return zipSync(Object.fromEntries(all), { mtime: DATE, level: 9 });
}

/** Reads an archive. What a system hides, such as `.git`, is passed over. */
export function unzip(bytes: Uint8Array): KeptFiles {
  if (bytes.length > MOST_ARCHIVE) {
    throw new ZipError("the archive is larger than 20 MB");
  }
  const paths = new Map<string, string>();
  let size = 0;
  const unpacked = opened(bytes, (name, originalSize) => {
    const path = pathOf(name);
    if (path === null) {
      return false;
    }
    size += originalSize;
    if (originalSize > MOST_FILE) {
      throw new ZipError(`${path} is larger than 1 MB`);
    }
    if (size > MOST_BYTES) {
      throw new ZipError("the files are larger than 20 MB together");
    }
    if (paths.size === MOST_FILES) {
      throw new ZipError(`the archive has more than ${MOST_FILES} files`);
    }
    if ([...paths.values()].includes(path)) {
      throw new ZipError(`the archive has two files ${path}`);
    }
    paths.set(name, path);
    return true;
  });
  return [...paths].map(([name, path]) => [path, contentsOf(unpacked[name] ?? new Uint8Array())]);
}

/** The contents of the wanted files, each of the size that the archive says. */
function opened(bytes: Uint8Array, wants: (name: string, size: number) => boolean): Record<string, Uint8Array> {
  const sizes = new Map<string, number>();
  const filter = ({ name, originalSize }: { name: string; originalSize: number }): boolean => {
    sizes.set(name, originalSize);
    return wants(name, originalSize);
  };
  try {
    const found = unzipSync(bytes, { filter });
    if (Object.entries(found).every(([name, contents]) => contents.length === sizes.get(name))) {
      return found;
    }
  } catch (error) {
    if (error instanceof ZipError) {
      throw error;
    }
  }
  throw new ZipError("this is not a zip archive, or it is damaged");
}

/** A path within the folder; null for a folder, and for what systems hide. */
function pathOf(name: string): string | null {
  const parts = name.replaceAll("\\", "/").split("/");
  if (parts.at(-1) === "" || parts.some(part => (part.startsWith(".") && part !== "..") || part === "__MACOSX")) {
    return null;
  }
  if (parts.some(part => part === "" || part === ".." || INVISIBLE.test(part))) {
    throw new ZipError(`the archive has a file outside of its folder: ${name}`);
  }
  return parts.join("/");
}

export function contentsOf(bytes: Uint8Array): Contents {
  const text = strFromU8(bytes);
  return text.includes("\ufffd") ? bytes.slice() : text;
}
