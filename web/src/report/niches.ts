// The niches of a map.

import type { PageElite } from "../protocol";

/** The fittest elite of each niche of two axes, of all along the others. */
export function fittest(
  elites: Pick<PageElite, "behavior" | "niche" | "fitness">[],
  x: number,
  y: number,
): Map<string, number> {
  const best = new Map<string, number>();
  const fitness = (at: number | undefined): number => elites[at ?? -1]?.fitness[0] ?? -Infinity;
  elites.forEach(({ behavior, niche }, at) => {
    const place = placeOf(behavior, niche[x] ?? 0, niche[y] ?? 0);
    if (fitness(best.get(place)) < fitness(at)) {
      best.set(place, at);
    }
  });
  return best;
}

/** A niche of the map of a behavior. */
export function placeOf(behavior: string, column: number, row: number): string {
  return `${behavior} ${column} ${row}`;
}
