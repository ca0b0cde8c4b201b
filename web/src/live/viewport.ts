// Which part of a drawing is seen, and how large: a corner of it and the pixels of a unit.

export interface Box {
  x: number;
  y: number;
  width: number;
  height: number;
}

/** Room in pixels beside a drawing that is seen as a whole. */
export interface Margins {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

const LARGEST = 4;
export const LARGEST_WHOLE = 1.5;

export class Viewport {
  width = 0;
  height = 0;
  scale = 1;
  #x = 0;
  #y = 0;
  #whole = 1;

  get box(): Box {
    return { x: this.#x, y: this.#y, width: this.width / this.scale, height: this.height / this.scale };
  }

  get isWhole(): boolean {
    return this.scale <= this.#whole;
  }

  /** Shows all of a drawing. Its margins depend on the scale, and the scale on them. */
  fit(content: Box, margins: (scale: number) => Margins): void {
    let scale = LARGEST;
    for (let pass = 0; pass < 4; pass++) {
      const { left, right, top, bottom } = margins(scale);
      const [across, down] = [this.width - left - right, this.height - top - bottom];
      scale = Math.max(0.01, Math.min(across / content.width, down / content.height, LARGEST_WHOLE));
    }
    const { left, right, top, bottom } = margins(scale);
    const spare = [
      this.width - left - right - content.width * scale,
      this.height - top - bottom - content.height * scale,
    ].map(pixels => Math.max(0, pixels) / 2) as [number, number];
    this.scale = this.#whole = scale;
    this.#x = content.x - (left + spare[0]) / scale;
    this.#y = content.y - (top + spare[1]) / scale;
  }

  /** Shows `factor` times as large what is at a place of the pane, which stays where it is. */
  zoom(factor: number, x = this.width / 2, y = this.height / 2): void {
    const scale = Math.min(LARGEST, Math.max(this.#whole / 2, this.scale * factor));
    this.#x += x / this.scale - x / scale;
    this.#y += y / this.scale - y / scale;
    this.scale = scale;
  }

  move(across: number, down: number): void {
    this.#x -= across / this.scale;
    this.#y -= down / this.scale;
  }

  /** Shows a box in the middle, at a scale or at that of now. */
  center({ x, y, width, height }: Box, scale = this.scale): void {
    this.scale = scale;
    this.#x = x + width / 2 - this.width / scale / 2;
    this.#y = y + height / 2 - this.height / scale / 2;
  }
}
