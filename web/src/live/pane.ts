// A canvas as large as its visible part, in a pane that scrolls over a taller picture.

import { element } from "../element";

export type Pen = CanvasRenderingContext2D;

export class CanvasPane {
  readonly canvas = element("canvas");
  readonly host: HTMLElement;
  // Sizes are noted when they change: to ask for them at every drawing would make the browser lay out the page.
  width = 0;
  height = 0;
  scrolled = 0;
  readonly #spacer = element("div", { class: "spacer" });
  readonly #pen: Pen;
  /** Pixels of the picture below the visible part. */
  #below = -1;

  constructor(name: string, label: string, changed: () => void) {
    this.host = element(
      "div",
      { class: `pane ${name}`, tabindex: 0, role: "group", "aria-label": label },
      this.canvas,
      this.#spacer,
    );
    this.#pen = this.canvas.getContext("2d") as Pen;
    const note = (): void => {
      this.width = this.host.clientWidth;
      this.height = this.host.clientHeight;
      this.scrolled = this.host.scrollTop;
      changed();
    };
    this.host.addEventListener("scroll", note, { passive: true });
    new ResizeObserver(note).observe(this.host);
  }

  get visible(): boolean {
    return this.width > 0 && this.height > 0 && !document.hidden;
  }

  /** Clears the visible part of a picture that is `total` pixels high. */
  begin(total: number): Pen {
    const ratio = devicePixelRatio || 1;
    const [width, height] = [Math.round(this.width * ratio), Math.round(this.height * ratio)];
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
      this.canvas.style.width = `${this.width}px`;
      this.canvas.style.height = `${this.height}px`;
    }
    const below = Math.max(0, total - this.height);
    if (below !== this.#below) {
      this.#below = below;
      this.#spacer.style.height = `${below}px`;
    }
    this.#pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.#pen.clearRect(0, 0, this.width, this.height);
    return this.#pen;
  }
}
