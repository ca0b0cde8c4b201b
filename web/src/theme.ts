// Light or dark, large type for a projector, and the colors that canvases draw with.

import { Observable } from "./observable";
import { THREAD_COLORS } from "./live/waves";
import { recall, remember } from "./memory";

export interface Colors {
  ink: string;
  dim: string;
  paper: string;
  panel: string;
  line: string;
  one: string;
  zero: string;
  accent: string;
  highlight: string;
  sky: string;
  ground: string;
  tick: string;
  edge: string;
  good: string;
  bad: string;
  /** Of the threads of a wave machine, and of what stands on them. */
  threads: string[];
  onThread: string;
  font: string;
}

type Theme = "light" | "dark";

const dark = matchMedia("(prefers-color-scheme: dark)");
const still = matchMedia("(prefers-reduced-motion: reduce)");

export const colors = new Observable<Colors>(readColors());
/** The size of type relative to the usual one. */
export const enlargement = new Observable(1);

export function prefersStillness(): boolean {
  return still.matches;
}

/** What the reader chose; null follows the system. */
let chosen: Theme | null = null;

export function theme(): Theme {
  return chosen ?? systemTheme();
}

function systemTheme(): Theme {
  return dark.matches ? "dark" : "light";
}

export function switchTheme(): void {
  const other: Theme = theme() === "dark" ? "light" : "dark";
  // A choice that agrees with the system follows the system again.
  chosen = other === systemTheme() ? null : other;
  remember("theme", chosen);
  applyTheme();
}

/** Style sheets and canvases take the colors of the theme. */
function applyTheme(): void {
  document.documentElement.dataset["theme"] = theme();
  colors.set(readColors());
}

export function switchProjector(): boolean {
  const large = document.documentElement.toggleAttribute("data-projector");
  remember("projector", large ? true : null);
  enlargement.set(large ? 1.35 : 1);
  return large;
}

export function restoreTheme(): void {
  chosen = recall<Theme>("theme");
  if (recall<boolean>("projector") === true) {
    switchProjector();
  }
  dark.addEventListener("change", applyTheme);
  applyTheme();
}

function readColors(): Colors {
  const style = getComputedStyle(document.documentElement);
  const named = (name: string): string => style.getPropertyValue(`--${name}`).trim();
  return {
    ink: named("ink"),
    dim: named("dim"),
    paper: named("paper"),
    panel: named("panel"),
    line: named("line"),
    one: named("one"),
    zero: named("zero"),
    accent: named("accent"),
    highlight: named("highlight"),
    sky: named("sky"),
    ground: named("ground"),
    tick: named("tick"),
    edge: named("edge"),
    good: named("good"),
    bad: named("bad"),
    threads: Array.from({ length: THREAD_COLORS }, (_, i) => named(`thread-${i + 1}`)),
    onThread: named("on-thread"),
    font: named("font"),
  };
}
