// The grid of the designer: voxels are painted with the mouse, a finger or the keyboard.

import { element, fill } from "../element";
import type { VoxelLook } from "../protocol";
import { EMPTY, sizeOf, voxelAt, type Body } from "./body";

export interface GridEvents {
  /** A voxel was painted; `merge` if it belongs to the stroke before. */
  paint: (x: number, y: number, code: string | null, merge: boolean) => void;
  brush: () => string;
}

export class Grid {
  readonly host = element("div", {
    class: "grid",
    role: "grid",
    "aria-label": "Body; arrows move, digits paint, Delete empties",
  });
  #cells: HTMLElement[][] = [];
  #body: Body = [];
  #at: [number, number] = [0, 0];
  /** What this stroke paints; null while there is none. */
  #stroke: string | null = null;

  constructor(private readonly events: GridEvents) {
    this.host.addEventListener("pointerdown", event => this.#press(event));
    this.host.addEventListener("pointermove", event => this.#drag(event));
    addEventListener("pointerup", () => {
      this.#stroke = null;
    });
    this.host.addEventListener("focusin", event => {
      const { x, y } = (event.target as HTMLElement).dataset;
      this.#at = [Number(x), Number(y)];
    });
    this.host.addEventListener("keydown", event => this.#key(event));
    this.host.addEventListener("contextmenu", event => event.preventDefault());
  }

  show(body: Body, looks: Map<string, VoxelLook>, names: Map<string, string>): void {
    if (sizeOf(body).join() !== sizeOf(this.#body).join()) {
      this.#build(body);
    }
    this.#body = body;
    this.#cells.forEach((row, y) =>
      row.forEach((cell, x) => {
        const code = voxelAt(body, x, y);
        cell.dataset["code"] = code;
        cell.style.background = looks.get(code)?.color ?? "";
        cell.style.color = code === EMPTY ? "" : inkOn(looks.get(code)?.color ?? "#888888");
        cell.textContent = code === EMPTY ? "" : code;
        cell.setAttribute("aria-label", `column ${x + 1}, row ${y + 1}: ${names.get(code) ?? "empty"}`);
      }),
    );
  }

  #build(body: Body): void {
    const [width, height] = sizeOf(body);
    this.host.style.setProperty("--columns", String(width));
    this.#cells = Array.from({ length: height }, (_, y) =>
      Array.from({ length: width }, (__, x) =>
        element("div", { role: "gridcell", class: "voxel", "data-x": x, "data-y": y, tabindex: -1 }),
      ),
    );
    fill(this.host, ...this.#cells.map(row => element("div", { role: "row", class: "line" }, ...row)));
    this.#move(Math.min(this.#at[0], width - 1), Math.min(this.#at[1], height - 1), false);
  }

  #move(x: number, y: number, focus: boolean): void {
    this.#cells.flat().forEach(cell => (cell.tabIndex = -1));
    const cell = this.#cells[y]?.[x];
    if (cell !== undefined) {
      this.#at = [x, y];
      cell.tabIndex = 0;
      if (focus) {
        cell.focus();
      }
    }
  }

  #place(event: PointerEvent): [number, number] | null {
    const found = document.elementFromPoint(event.clientX, event.clientY)?.closest<HTMLElement>(".voxel");
    return found === null || found === undefined || !this.host.contains(found)
      ? null
      : [Number(found.dataset["x"]), Number(found.dataset["y"])];
  }

  /** Painting with what is there already empties; so does the right button. */
  #press(event: PointerEvent): void {
    const place = this.#place(event);
    if (place !== null) {
      event.preventDefault();
      const same = voxelAt(this.#body, ...place) === this.events.brush();
      this.#stroke = event.button === 2 || same ? EMPTY : this.events.brush();
      this.#move(...place, true);
      this.events.paint(...place, this.#stroke, false);
    }
  }

  #drag(event: PointerEvent): void {
    const place = this.#stroke === null ? null : this.#place(event);
    if (place !== null) {
      this.events.paint(...place, this.#stroke, true);
    }
  }

  #key(event: KeyboardEvent): void {
    const [x, y] = this.#at;
    const step: [number, number] | undefined = (
      { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] } as Record<
        string,
        [number, number]
      >
    )[event.key];
    if (step !== undefined) {
      this.#move(x + step[0], y + step[1], true);
    } else if (event.key === " " || event.key === "Enter") {
      this.events.paint(x, y, this.events.brush(), false);
    } else if (event.key === "Delete" || event.key === "Backspace") {
      this.events.paint(x, y, EMPTY, false);
    } else if (/^[0-9a-z]$/.test(event.key) && !event.ctrlKey && !event.metaKey) {
      this.events.paint(x, y, event.key, false);
    } else {
      return;
    }
    event.preventDefault();
  }
}

export function inkOn(color: string): string {
  const [r, g, b] = [1, 3, 5].map(i => parseInt(color.slice(i, i + 2), 16)) as [number, number, number];
  return 0.3 * r + 0.6 * g + 0.1 * b > 140 ? "#000" : "#fff";
}
