// The archive of an evolution: a map for each behavior, whose niches open their elites, which walk.

import { colors } from "../colors";
import { element, fill } from "../element";
import type { Pen } from "../live/pane";
import type { Gait } from "../robots/gait";
import { GaitView } from "../robots/walk";
import { Clock } from "./clock";
import type { EvolutionData, PageElite } from "../protocol";
import { gaitOf } from "./data";
import { fittest, placeOf } from "./niches";
import { describe, drawPresence, part } from "./shown";

/** Pixels of the longer side of an image. */
const IMAGE = 64;

export class Archive {
  #chosen = -1;
  #walk: { view: GaitView; gait: Gait } | null = null;
  readonly #maps = part(document, ".maps");
  readonly #panel = part(document, ".robot");
  readonly #player = part(document, ".player");
  readonly #stage = part<HTMLCanvasElement>(document, ".stage");
  readonly #axes = [...document.querySelectorAll<HTMLSelectElement>(".axis")];
  readonly #clock: Clock;

  constructor(private readonly data: EvolutionData) {
    this.#clock = new Clock(this.#player, data.patterns.length * data.cycles, () => this.#draw());
    this.#axes.forEach(axis => axis.addEventListener("change", () => this.#drawMaps()));
    this.#maps.addEventListener("keydown", event => this.#press(event));
    new ResizeObserver(() => this.#clock.wake()).observe(this.#stage);
    colors.on(() => this.#clock.wake());
    this.#drawMaps();
    this.#open(0);
  }

  #drawMaps(): void {
    const [x = -1, y = -1] = this.#axes.map(axis => Number(axis.value));
    const best = fittest(this.data.elites, x, y);
    fill(this.#maps, ...this.data.behaviors.map(behavior => this.#map(behavior, [x, y], best)));
  }

  #map(behavior: EvolutionData["behaviors"][number], [x, y]: [number, number], best: Map<string, number>): HTMLElement {
    const [columns, rows] = [this.data.axes[x]?.bins ?? 1, this.data.axes[y]?.bins ?? 1];
    const grid = element("div", { class: "niches" });
    grid.style.gridTemplateColumns = `repeat(${columns}, 1fr)`;
    for (let row = rows - 1; row >= 0; row--) {
      for (let column = 0; column < columns; column++) {
        grid.append(this.#niche(best.get(placeOf(behavior.word, column, row))));
      }
    }
    const isEmpty = grid.querySelector("button") === null;
    const title = element("h3", {}, `${behavior.word} `, element("span", {}, behavior.function));
    return element("div", { class: isEmpty ? "map none" : "map" }, title, grid);
  }

  #niche(at: number | undefined): HTMLElement {
    const elite = this.data.elites[at ?? -1];
    if (elite === undefined || at === undefined) {
      return element("span", { class: "niche" });
    }
    const fitness = elite.about[0]?.join(" ") ?? "";
    const made = element("button", {
      type: "button",
      class: at === this.#chosen ? "niche chosen" : "niche",
      "data-elite": at,
      "aria-label": `${elite.behavior}, ${fitness}`,
      title: fitness,
      onclick: () => {
        this.#open(at);
        this.#stage.scrollIntoView({ block: "nearest" });
        if (this.#walk !== null) {
          this.#clock.play();
        }
      },
    });
    made.style.background = elite.color;
    return made;
  }

  /** Arrow keys go from niche to niche. */
  #press(event: KeyboardEvent): void {
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    if (step === undefined) {
      return;
    }
    event.preventDefault();
    const niches = [...this.#maps.querySelectorAll("button")];
    const at = niches.findIndex(niche => niche === document.activeElement);
    niches[Math.max(0, Math.min(niches.length - 1, at + step))]?.focus();
  }

  /** Shows an elite at the start of its gait. */
  #open(at: number): void {
    const elite = this.data.elites[at];
    if (elite === undefined) {
      return;
    }
    this.#chosen = at;
    for (const niche of this.#maps.querySelectorAll("button")) {
      niche.classList.toggle("chosen", Number(niche.dataset["elite"]) === at);
    }
    describe(this.#panel, `${elite.behavior} ${elite.function}`, elite.about);
    this.#walk = this.#walkOf(elite);
    this.#player.hidden = this.#walk === null;
    part(document, ".missing").hidden = this.#walk !== null;
    this.#clock.seek(0);
  }

  #walkOf({ width, height, gait }: PageElite): { view: GaitView; gait: Gait } | null {
    if (gait === undefined) {
      return null;
    }
    const looking = { voxels: gait.voxels, looks: this.data.looks, tall: height + 1, wide: 2 * width };
    const view = new GaitView(this.#stage, looking);
    return { view, gait: gaitOf(gait, this.data.pace) };
  }

  #draw(): void {
    this.#walk?.view.draw(this.#walk.gait, this.#clock.time);
    const pen = this.#stage.getContext("2d");
    const shown = Math.min(this.data.patterns.length - 1, Math.floor(this.#clock.time / this.data.cycles));
    const [image, pattern = ""] = [this.data.images[shown], this.data.patterns[shown]];
    if (pen === null) {
      return;
    }
    if (image !== undefined) {
      drawImage(pen, image, 8, 8);
      return;
    }
    [...pattern].forEach((bit, i) => drawPresence(pen, i, Number(bit), 8, 8));
    pen.fillStyle = colors.value.ink;
    pen.font = `13px ${colors.value.font}`;
    pen.textAlign = "left";
    pen.textBaseline = "alphabetic";
    pen.fillText(`stimuli ${pattern}`, 12 + 22 * pattern.length, 20);
  }
}

/** An image, black for 1. */
function drawImage(pen: Pen, rows: number[][], left: number, top: number): void {
  const side = IMAGE / Math.max(rows.length, rows[0]?.length ?? 1);
  rows.forEach((row, y) =>
    row.forEach((value, x) => {
      const gray = Math.round(255 - 229 * value);
      pen.fillStyle = `rgb(${gray}, ${gray}, ${gray})`;
      pen.fillRect(left + x * side, top + y * side, side + 0.5, side + 0.5);
    }),
  );
}
