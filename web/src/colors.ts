// The colors that canvases draw with: those of the style sheet.

import { THREAD_COLORS } from "./live/waves";
import { Observable } from "./observable";

const NAMES = [
  "ink",
  "dim",
  "paper",
  "panel",
  "line",
  "one",
  "zero",
  "accent",
  "highlight",
  "sky",
  "ground",
  "tick",
  "edge",
  "good",
  "bad",
  "font",
] as const;
type Named = Record<(typeof NAMES)[number], string>;

export interface Colors extends Named {
  /** Of the threads of a wave machine, and of what stands on them. */
  threads: string[];
  onThread: string;
}

export const colors = new Observable<Colors>(readColors());

export function refreshColors(): void {
  colors.set(readColors());
}

export function styled(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

function readColors(): Colors {
  return {
    ...(Object.fromEntries(NAMES.map(name => [name, styled(name)])) as Named),
    threads: Array.from({ length: THREAD_COLORS }, (_, i) => styled(`thread-${i + 1}`)),
    onThread: styled("on-thread"),
  };
}
