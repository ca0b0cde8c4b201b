// The designer: paint a body, and see at once how it walks and which gate it is.

import { element, fill, iconButton, button } from "../element";
import { swatch } from "../live/legend";
import { Observable } from "../observable";
import type { PaletteEntry, ProbeReport, RobotCards, VoxelLook } from "../protocol";
import { recall, remember } from "../memory";
import {
  EMPTY,
  LARGEST,
  countVoxels,
  drawnFrom,
  emptyBody,
  mirrored,
  paint,
  randomBody,
  resized,
  sizeOf,
  swappedInputs,
  type Body,
} from "./body";
import { Grid } from "./grid";
import { History } from "./history";
import { looksByCode } from "./portrait";
import type { Probing } from "./probing";

const PAUSE = 150;
const CYCLES = 8;
const FIRST = "nand_5x5";

/** A body and how it walks; null while that is not known. */
export interface Design {
  body: Body;
  probe: ProbeReport | Fault | null;
}

export interface Fault {
  fault: string;
}

export class Designer {
  readonly host = element("section", { class: "designer", "aria-label": "Designer" });
  readonly design: Observable<Design>;
  readonly #history: History<Body>;
  readonly #grid: Grid;
  readonly #palette = element("div", { class: "palette", role: "radiogroup", "aria-label": "Material to paint with" });
  readonly #undo = iconButton("undo", "Undo (Ctrl-Z)", () => this.#back(() => this.#history.undo()), {
    "data-do": "undo",
  });
  readonly #redo = iconButton("redo", "Redo (Ctrl-Y)", () => this.#back(() => this.#history.redo()), {
    "data-do": "redo",
  });
  readonly #sizes = { width: this.#sizeField("width"), height: this.#sizeField("height") };
  #materials: PaletteEntry[] = [];
  #looks: VoxelLook[] = [];
  #brush = "3";
  #timer = 0;
  #work: AbortController | null = null;

  constructor(private readonly probing: Probing) {
    const body = recall<string[]>("design") ?? emptyBody(5, 5);
    this.#history = new History<Body>(body);
    this.design = new Observable<Design>({ body, probe: null });
    this.#grid = new Grid({
      brush: () => this.#brush,
      paint: (x, y, code, merge) => this.#paint(x, y, code ?? this.#brush, merge),
    });
    this.host.append(element("div", { class: "bench" }, this.#grid.host, this.#palette), this.#tools());
    this.host.addEventListener("keydown", event => this.#key(event));
  }

  get body(): Body {
    return this.#history.present;
  }

  /** Takes what one can paint with. A first visit begins with a robot that walks. */
  setMaterials({ palette, looks, robots }: RobotCards): void {
    const first = robots.find(robot => robot.name === FIRST && robot.painted);
    if (this.#materials.length === 0 && recall("design") === null && first !== undefined) {
      this.#history.push(first.body, false);
    }
    const empty: PaletteEntry = { code: EMPTY, name: "empty", about: "no voxel", look: -1 };
    this.#materials = [empty, ...palette.filter(({ code }) => code !== EMPTY)];
    this.#looks = looks;
    this.#showPalette();
    this.#show();
    if (this.design.value.probe === null) {
      this.#probe();
    }
  }

  take(body: Body): void {
    this.#change(body);
  }

  #paint(x: number, y: number, code: string, merge: boolean): void {
    const known = this.#materials.some(material => material.code === code);
    if (known) {
      this.#change(paint(this.body, x, y, code), merge);
    }
  }

  #change(body: Body, merge = false): void {
    this.#history.push(body, merge);
    this.#show();
    this.#probeSoon();
  }

  #back(step: () => void): void {
    step();
    this.#show();
    this.#probeSoon();
  }

  #show(): void {
    const names = new Map(this.#materials.map(({ code, name }) => [code, name]));
    this.#grid.show(this.body, looksByCode(this.#looks, this.#materials), names);
    this.#undo.disabled = !this.#history.canUndo;
    this.#redo.disabled = !this.#history.canRedo;
    const [width, height] = sizeOf(this.body);
    this.#sizes.width.value = String(width);
    this.#sizes.height.value = String(height);
    remember("design", this.body);
  }

  #probeSoon(): void {
    this.#work?.abort();
    this.design.set({ body: this.body, probe: null });
    clearTimeout(this.#timer);
    this.#timer = window.setTimeout(() => this.#probe(), PAUSE);
  }

  #probe(): void {
    const { body } = this;
    if (countVoxels(body) === 0) {
      this.design.set({ body, probe: { fault: "the body is empty: choose a material and paint" } });
      return;
    }
    this.#work?.abort();
    const work = new AbortController();
    this.#work = work;
    const show = (probe: ProbeReport | Fault): void => {
      if (!work.signal.aborted && body === this.body) {
        this.design.set({ body, probe });
      }
    };
    void this.#ask(body, work.signal, show).catch((error: Error) => show({ fault: error.message }));
  }

  /** The gaits come at once, the numbers of a gate after them. */
  async #ask(body: Body, signal: AbortSignal, show: (probe: ProbeReport) => void): Promise<void> {
    const quick = await this.probing.now(body, CYCLES, signal);
    show(quick);
    if (!signal.aborted && quick.character === null) {
      show(await this.probing.thoroughly(body, CYCLES, signal));
    }
  }

  #showPalette(): void {
    const choose = (code: string): void => {
      this.#brush = code;
      this.#showPalette();
    };
    fill(
      this.#palette,
      ...this.#materials.map(({ code, name, about, look }) =>
        element(
          "button",
          {
            type: "button",
            role: "radio",
            title: about,
            "data-code": code,
            "aria-checked": String(code === this.#brush),
            onclick: () => choose(code),
          },
          element("kbd", {}, code),
          code === EMPTY ? element("span", { class: "swatch none" }) : swatch(this.#looks[look]),
          element("span", {}, name),
        ),
      ),
    );
  }

  #tools(): HTMLElement {
    const random = (): void => {
      // Without its materials there is no body.
      if (this.#materials.length > 0) {
        this.#change(randomBody(...sizeOf(this.body), drawnFrom(this.body, this.#materials)));
      }
    };
    return element(
      "div",
      { class: "tools row" },
      this.#undo,
      this.#redo,
      button("Mirror", () => this.#change(mirrored(this.body)), { "data-do": "mirror", title: "Left becomes right" }),
      button("Swap inputs", () => this.#change(swappedInputs(this.body, this.#materials)), {
        "data-do": "swap",
        title: "Exchange the materials that sense stimulus 1 and stimulus 2",
      }),
      button("Random", random, { "data-do": "random", title: "A random body" }),
      button("Clear", () => this.#change(emptyBody(...sizeOf(this.body))), { "data-do": "clear" }),
      element("label", {}, "size ", this.#sizes.width, " × ", this.#sizes.height),
    );
  }

  #sizeField(side: "width" | "height"): HTMLInputElement {
    const field: HTMLInputElement = element("input", {
      type: "number",
      min: 1,
      max: LARGEST,
      "aria-label": `${side} of the body`,
      "data-size": side,
      onchange: () => {
        const [width, height] = [Number(this.#sizes.width.value), Number(this.#sizes.height.value)];
        if ([width, height].every(size => Number.isInteger(size) && size >= 1 && size <= LARGEST)) {
          this.#change(resized(this.body, width, height));
        } else {
          this.#show();
        }
      },
    });
    return field;
  }

  #key(event: KeyboardEvent): void {
    const key = event.key.toLowerCase();
    if ((event.ctrlKey || event.metaKey) && (key === "z" || key === "y")) {
      event.preventDefault();
      this.#back(() => (key === "y" || event.shiftKey ? this.#history.redo() : this.#history.undo()));
    }
  }
}
