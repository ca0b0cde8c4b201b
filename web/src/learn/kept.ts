// The programs that a learner wrote in a lesson and that were replaced, and where they were saved, remembered by the
// browser.

import { own, recall, remember } from "../memory";

export interface KeptProgram {
  text: string;
  /** When it was replaced, in milliseconds since 1970. */
  at: number;
}

const MOST = 10;

/** The kept programs of a lesson, the latest first. */
export function keptPrograms(folder: string, lesson: string): KeptProgram[] {
  return recall<KeptProgram[]>(name(folder, lesson)) ?? [];
}

/** Keeps a program; one that was kept before becomes the latest. */
export function keepProgram(folder: string, lesson: string, program: KeptProgram): void {
  const others = keptPrograms(folder, lesson).filter(other => other.text !== program.text);
  remember(name(folder, lesson), [program, ...others].slice(0, MOST));
}

function name(folder: string, lesson: string): string {
  return own(`kept:${folder}:${lesson}`);
}

export function savedFile(folder: string, lesson: string): string | null {
  return recall<string>(own(`lesson-file:${folder}:${lesson}`));
}

export function noteSavedFile(folder: string, lesson: string, path: string | null): void {
  remember(own(`lesson-file:${folder}:${lesson}`), path);
}
