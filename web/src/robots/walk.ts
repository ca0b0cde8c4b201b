// A canvas with one robot that walks.

import { followWithSlack, middleOf } from "../live/camera";
import { drawGround, drawRobot } from "../live/drawing";
import type { SwarmRobot, VoxelLook } from "../protocol";
import { colors } from "../theme";
import { outlineAt, type Gait } from "./gait";

/** The part of a body that never changes while it walks. */
export interface Looking {
  voxels: SwarmRobot["voxels"];
  looks: VoxelLook[];
  height: number;
}

/** A canvas with one robot on the ground. */
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
    const outline = outlineAt(gait, time);
    const place = middleOf(outline);
    const ground = height - 10;
    const scale = Math.min((ground - 2) / (this.looking.height * 1.45), width / 11);
    this.#camera = followWithSlack(time === 0 ? place : this.#camera, place, width / scale / 5);
    const lane = { left: 0, top: 0, width, height, ground, scale, camera: this.#camera, columns: [] };
    drawGround(pen, lane, colors.value, false);
    drawRobot(pen, outline, this.looking.voxels, this.looking.looks, lane, colors.value);
  }
}
