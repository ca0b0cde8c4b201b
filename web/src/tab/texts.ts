// The files that all programs of the page have, and those of them that the browser could not keep.

import type { Contents, KeptFiles } from "./files";

export class Texts {
  readonly #texts = new Map<string, Contents>();
  readonly #unkept = new Set<string>();

  get all(): KeptFiles {
    return [...this.#texts].sort(([a], [b]) => (a < b ? -1 : 1));
  }

  /** Without a text, the file is gone. */
  note(path: string, text: Contents | null): void {
    if (text === null) {
      this.#texts.delete(path);
    } else {
      this.#texts.set(path, text);
    }
  }

  /** What the user should know then. */
  noteKept(path: string, isKept: boolean): string {
    this.#unkept[isKept ? "delete" : "add"](path);
    const paths = [...this.#unkept].join(", ");
    return paths === "" ? "" : `This browser could not keep ${paths}: save it from Share.`;
  }
}
