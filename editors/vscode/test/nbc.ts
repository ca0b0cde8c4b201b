// The program and the gallery that the tests use.

import { existsSync, readdirSync, readFileSync } from "node:fs";
import * as path from "node:path";

/** The folder of the project; tests run in the folder of the extension. */
export const ROOT = path.resolve("../..");

/** The program: the variable NBC, or what `cargo build --release` made. */
export const NBC = path.resolve(process.env.NBC ?? path.join(ROOT, "target/release/nbc"));

if (!existsSync(NBC)) {
  throw new Error(`${NBC} does not exist: build it with cargo build --release, or name another with NBC`);
}

/** The programs of the gallery. */
export const GALLERY = readdirSync(path.join(ROOT, "circuits"))
  .filter(name => name.endsWith(".nb"))
  .map(name => path.join(ROOT, "circuits", name));

/** The examples of the manual that are whole programs in themselves. */
export function manual(page: string): string[] {
  const text = readFileSync(path.join(ROOT, "docs", page), "utf8");
  return [...text.matchAll(/^```nb\n([^]*?)^```$/gm)].map(match => match[1]!);
}
