// A canvas with one robot that walks.

import { colors } from "../colors";
import { drawWalk, type Walking } from "../live/walk";
import { outlineAt, type Gait } from "./gait";

/** The part of a body that never changes while it walks. */
export type Looking = Pick<Walking, "voxels" | "looks" | "tall" | "wide">;

export class GaitView {
  #camera: number | undefined;

  constructor(
    readonly canvas: HTMLCanvasElement,
    private readonly looking: Looking,
  ) {}

  draw(gait: Gait, time: number): void {
    const ratio = devicePixelRatio || 1;
    const [width, height] = [this.canvas.clientWidth, this.canvas.clientHeight];
    const pen = this.canvas.getContext("2d");
    if (pen === null || width === 0) {
      return;
    }
    if (this.canvas.width !== Math.round(width * ratio) || this.canvas.height !== Math.round(height * ratio)) {
      this.canvas.width = Math.round(width * ratio);
      this.canvas.height = Math.round(height * ratio);
    }
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    const area = { left: 0, top: 0, width, height };
    const walking = { ...this.looking, outline: outlineAt(gait, time), columns: [] };
    this.#camera = drawWalk(pen, area, walking, time === 0 ? undefined : this.#camera, colors.value);
  }
}
