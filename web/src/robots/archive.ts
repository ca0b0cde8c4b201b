// The archive of a search as it fills: a heat map for each behavior, with a square for each niche.

import { element, fill } from "../element";
import { gateName, gateOf, lettersOf } from "../gate";
import type { ArchiveAxis, ArchiveChange, EliteData } from "../protocol";

export class Archive {
  readonly niches = new Map<string, EliteData>();
  axes: ArchiveAxis[] = [];
  evaluations = 0;
  generation = 0;

  clear(): void {
    this.niches.clear();
    this.axes = [];
    this.evaluations = 0;
    this.generation = 0;
  }

  merge(event: ArchiveChange): void {
    this.axes = event.axes;
    this.evaluations = event.evaluations;
    this.generation = event.generation;
    for (const niche of event.niches) {
      this.niches.set(niche.niche.join(), niche);
    }
  }

  /** The best value of the last part of the fitness, for the scale of colors. */
  best(): number {
    return Math.max(1e-9, ...[...this.niches.values()].map(strength));
  }

  /** The axes that a map shows, and those of which each combination of places is a map of its own. */
  split(): { across: number[]; layers: number[] } {
    const all = this.axes.map((_, axis) => axis);
    const across = all.filter(axis => this.axes[axis]?.name !== "behavior").slice(0, 2);
    return { across, layers: all.filter(axis => !across.includes(axis)) };
  }

  places(axes: number[]): number[][] {
    return axes.reduce<number[][]>(
      (places, axis) =>
        places.flatMap(place => Array.from({ length: this.axes[axis]?.bins ?? 1 }, (_, i) => [...place, i])),
      [[]],
    );
  }
}

export function strength(niche: EliteData): number {
  return niche.fitness.at(-1) ?? 0;
}

export class HeatMap {
  readonly host = element("div", { class: "maps" });
  #squares = new Map<string, HTMLButtonElement>();
  #titles = new Map<string, HTMLElement>();
  #shape = "";

  constructor(
    private readonly archive: Archive,
    private readonly choose: (niche: EliteData) => void,
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

  #open(place: string, niche: EliteData, best: number): void {
    const square = this.#squares.get(place);
    if (square === undefined) {
      return;
    }
    const share = Math.max(0, Math.min(1, strength(niche) / best));
    const fitness = niche.fitness.map(part => part.toFixed(3)).join(" and ");
    const words = `${gateName(niche.function)}, ${niche.behavior}, fitness ${fitness}`;
    square.disabled = false;
    square.style.setProperty("--share", `${Math.round(15 + 85 * share)}%`);
    square.title = words;
    square.setAttribute("aria-label", words);
    const title = this.#titles.get(
      this.archive
        .split()
        .layers.map(axis => niche.niche[axis])
        .join(),
    );
    if (title !== undefined) {
      title.textContent = gateName(niche.function);
      title.closest(".map")?.classList.remove("none");
    }
  }

  #build(): void {
    this.#squares.clear();
    this.#titles.clear();
    const { across, layers } = this.archive.split();
    const places = this.archive.places(layers);
    // Of the 256 behaviors of three stimuli, only those that are found have room.
    this.host.toggleAttribute("data-many", places.length > 16);
    fill(this.host, ...places.map(layer => this.#map(layer, layers, across)));
    const [columns = "", rows] = across.map(axis => this.archive.axes[axis]?.name ?? "");
    const names =
      rows === undefined
        ? `${columns} from left to right`
        : `${columns} from left to right, ${rows} from the bottom up`;
    this.host.setAttribute("aria-label", `Archive: ${names}`);
    this.host.title = names;
  }

  #map(layer: number[], layers: number[], across: number[]): HTMLElement {
    const title = element("h4", {}, this.#titleOf(layer, layers));
    this.#titles.set(layer.join(), title);
    const [columns = 1, rows = 1] = across.map(axis => this.archive.axes[axis]?.bins ?? 1);
    const squares = Array.from({ length: rows }, (_, row) =>
      Array.from({ length: columns }, (__, column) => {
        const place: number[] = [];
        layers.forEach((axis, i) => (place[axis] = layer[i] ?? 0));
        across.forEach((axis, i) => (place[axis] = i === 0 ? column : rows - 1 - row));
        return this.#square(place);
      }),
    );
    const niches = element("div", { class: "niches" }, ...squares.flat());
    niches.style.setProperty("--columns", String(columns));
    return element("div", { class: "map none" }, title, niches);
  }

  /** The gate of a behavior. Its number has a bit for each pattern, 00 the lowest. */
  #titleOf(layer: number[], layers: number[]): string {
    const index = layers.findIndex(axis => this.archive.axes[axis]?.name === "behavior");
    const [number, behaviors] = [layer[index], this.archive.axes[layers[index] ?? -1]?.bins ?? 1];
    return number === undefined ? "–" : gateName(gateOf(lettersOf(number, Math.log2(behaviors))));
  }

  #square(place: number[]): HTMLElement {
    const key = place.join();
    const square = element("button", {
      type: "button",
      class: "niche",
      disabled: true,
      "data-niche": key,
      "aria-label": "empty niche",
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
