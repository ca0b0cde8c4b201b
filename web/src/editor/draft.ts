// The unsaved text of each file, which survives a reload.

import { own, recall, remember } from "../memory";

export interface Draft {
  text: string;
  /** The stamp of the file that it was made from. */
  stamp: string | null;
  /** Whether nobody has changed it: it is kept only because no file has it. */
  untouched?: boolean;
}

function name(folder: string, path: string): string {
  return own(`draft:${folder}:${path}`);
}

export function draftOf(folder: string, path: string): Draft | null {
  return recall<Draft>(name(folder, path));
}

export function keepDraft(folder: string, path: string, draft: Draft | null): void {
  remember(name(folder, path), draft);
}
