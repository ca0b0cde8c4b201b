// A canvas as large as its visible part, in a pane that scrolls over a taller picture.

import { element } from "../element";

export type Pen = CanvasRenderingContext2D;

export class CanvasPane {
  readonly canvas = element("canvas");
  readonly host: HTMLElement;
  readonly #spacer = element("div", { class: "spacer" });
  #pen: Pen;

  constructor(name: string, label: string, changed: () => void) {
    this.host = element("div", { class: `pane ${name}`, tabindex: 0, role: "img", "aria-label": label }, this.canvas, this.#spacer);
    this.#pen = this.canvas.getContext("2d") as Pen;
    this.host.addEventListener("scroll", changed, { passive: true });
    new ResizeObserver(changed).observe(this.host);
  }

  get width(): number {
    return this.host.clientWidth;
  }

  get height(): number {
    return this.host.clientHeight;
  }

  get scrolled(): number {
    return this.host.scrollTop;
  }

  /** Whether it can be seen at all. */
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
    this.#spacer.style.height = `${Math.max(0, total - this.height)}px`;
    this.#pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.#pen.clearRect(0, 0, this.width, this.height);
    return this.#pen;
  }
}
