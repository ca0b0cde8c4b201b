// Light or dark, and large type for a projector.

import { refreshColors } from "./colors";
import { recall, remember } from "./memory";
import { Observable } from "./observable";

type Theme = "light" | "dark";

const dark = matchMedia("(prefers-color-scheme: dark)");
const still = matchMedia("(prefers-reduced-motion: reduce)");

export const enlargement = new Observable(1);

export const prefersStillness = (): boolean => still.matches;

/** What the reader chose; null follows the system. */
let chosen: Theme | null = null;

export const theme = (): Theme => chosen ?? systemTheme();
const systemTheme = (): Theme => (dark.matches ? "dark" : "light");

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
  refreshColors();
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
