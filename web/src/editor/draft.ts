// The unsaved text of each program, which survives a reload. Two tabs may have the same program: what another tab wrote
// is never replaced.

import { own, recalled, recallText, rememberText } from "../memory";

export interface Draft {
  text: string;
  stamp: string | null;
  /** Whether nobody has changed it: it is kept only because no file has it. */
  untouched?: boolean;
}

export class Drafts {
  /** The drafts as this tab has read or written them. */
  readonly #known = new Map<string, string | null>();

  constructor(private readonly folder: () => string) {}

  /** The draft of a program that this tab shows from now on. */
  open(path: string): Draft | null {
    this.#known.set(path, recallText(this.#name(path)));
    return this.of(path);
  }

  of(path: string): Draft | null {
    const kept = recallText(this.#name(path));
    return kept === null ? null : (JSON.parse(kept) as Draft);
  }

  /** Keeps a draft, or forgets it; false if another tab has written one that this tab has not read. */
  keep(path: string, draft: Draft | null): boolean {
    const [kept, text] = [recallText(this.#name(path)), draft && JSON.stringify(draft)];
    if (kept !== null && kept !== text && kept !== (this.#known.get(path) ?? null)) {
      return draft === null;
    }
    rememberText(this.#name(path), text);
    this.#known.set(path, text);
    return true;
  }

  /** The paths of the programs that somebody has changed and not saved. */
  get paths(): string[] {
    const prefix = this.#name("");
    const paths = recalled().flatMap(name => (name.startsWith(prefix) ? [name.slice(prefix.length)] : []));
    return paths.filter(path => this.of(path)?.untouched !== true).sort();
  }

  #name(path: string): string {
    return own(`draft:${this.folder()}:${path}`);
  }
}
