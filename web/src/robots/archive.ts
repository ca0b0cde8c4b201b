// The archive of a search as it fills: a heat map for each behavior, with a square for each niche.

import { element, fill } from "../element";
import { gateName } from "../gate";
import type { ArchiveEvent, Axis, Niche } from "../protocol";

export class Archive {
  readonly niches = new Map<string, Niche>();
  axes: Axis[] = [];
  evaluations = 0;
  generation = 0;

  clear(): void {
    this.niches.clear();
    this.axes = [];
    this.evaluations = 0;
    this.generation = 0;
  }

  merge(event: ArchiveEvent): void {
    this.axes = event.axes;
    this.evaluations = event.evaluations;
    this.generation = event.generation;
    for (const niche of event.niches) {
      this.niches.set(niche.place.join(), niche);
    }
  }

  /** The best value of the last part of the fitness, for the scale of colors. */
  best(): number {
    return Math.max(1e-9, ...[...this.niches.values()].map(strength));
  }

  /** The places of the axes after the first two, each a map of its own. */
  layers(): number[][] {
    return this.axes.slice(2).reduce<number[][]>(
      (layers, [, bins]) => layers.flatMap(layer => Array.from({ length: bins }, (_, i) => [...layer, i])),
      [[]],
    );
  }
}

/** What colors show: the last part of the fitness. */
export function strength(niche: Niche): number {
  return niche.fitness.at(-1) ?? 0;
}

export class HeatMap {
  readonly host = element("div", { class: "maps" });
  #squares = new Map<string, HTMLButtonElement>();
  #titles = new Map<string, HTMLElement>();
  #shape = "";

  constructor(
    private readonly archive: Archive,
    private readonly choose: (niche: Niche) => void,
  ) {}

  draw(): void {
    const shape = JSON.stringify(this.archive.axes);
    if (shape !== this.#shape) {
      this.#shape = shape;
      this.#build();
    }
    const best = this.archive.best();
    for (const [place, niche] of this.archive.niches) {
      this.#open(place, niche, best);
    }
  }

  #open(place: string, niche: Niche, best: number): void {
    const square = this.#squares.get(place);
    if (square === undefined) {
      return;
    }
    const share = Math.max(0, Math.min(1, strength(niche) / best));
    const words = `${gateName(niche.function)}, ${niche.letters}, fitness ${niche.fitness.map(part => part.toFixed(3)).join(" and ")}`;
    square.disabled = false;
    square.style.setProperty("--share", `${Math.round(15 + 85 * share)}%`);
    square.title = words;
    square.setAttribute("aria-label", words);
    const title = this.#titles.get(layerOf(niche.place));
    if (title !== undefined) {
      title.textContent = niche.function === null ? niche.letters : gateName(niche.function);
      title.closest(".map")?.classList.remove("none");
    }
  }

  #build(): void {
    this.#squares.clear();
    this.#titles.clear();
    const [first = ["", 1], second = ["", 1]] = this.archive.axes;
    fill(this.host, ...this.archive.layers().map(layer => this.#map(layer, first[1], second[1])));
    const names = this.archive.axes.slice(0, 2).map(([name]) => name).join(" from left to right, ");
    this.host.setAttribute("aria-label", `Archive: ${names} from the bottom up`);
  }

  #map(layer: number[], columns: number, rows: number): HTMLElement {
    const title = element("h4", {}, "–");
    this.#titles.set(layer.join(), title);
    const squares = Array.from({ length: rows }, (_, row) =>
      Array.from({ length: columns }, (__, column) => this.#square([column, rows - 1 - row, ...layer])),
    );
    const niches = element("div", { class: "niches" }, ...squares.flat());
    niches.style.setProperty("--columns", String(columns));
    return element("div", { class: "map none" }, title, niches);
  }

  #square(place: number[]): HTMLElement {
    const key = place.join();
    const square = element("button", {
      type: "button", class: "niche", disabled: true, "data-niche": key, "aria-label": "empty niche",
      onclick: () => {
        const niche = this.archive.niches.get(key);
        if (niche !== undefined) {
          this.choose(niche);
        }
      },
    });
    this.#squares.set(key, square);
    return square;
  }
}

function layerOf(place: number[]): string {
  return place.slice(2).join();
}
