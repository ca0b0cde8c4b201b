// How a body walks under one pattern: its poses, and a canvas that plays them.

import { followWithSlack, middleOf } from "../live/camera";
import { drawGround, drawRobot } from "../live/drawing";
import type { Outline } from "../live/playback";
import type { EncodedGait, Look, Voxel } from "../protocol";
import { colors } from "../theme";

export interface Gait {
  posesPerCycle: number;
  cycles: number;
  points: number;
  /** Hundredths of a voxel: the pose at the start, then those of all cycles. */
  coordinates: Int16Array;
}

export function decodeGait(encoded: EncodedGait): Gait {
  const raw = atob(encoded.poses);
  const bytes = Uint8Array.from(raw, letter => letter.charCodeAt(0));
  const view = new DataView(bytes.buffer);
  const coordinates = Int16Array.from({ length: bytes.length >> 1 }, (_, i) => view.getInt16(2 * i, true));
  const poses = encoded.frames * encoded.cycles + 1;
  return { posesPerCycle: encoded.frames, cycles: encoded.cycles, points: coordinates.length / poses / 2, coordinates };
}

/** The outline at a moment in cycles; before the start and after the end it stands still. */
export function outlineAt(gait: Gait, time: number): Outline {
  const size = 2 * gait.points;
  const last = gait.posesPerCycle * gait.cycles;
  const place = Math.min(last, Math.max(0, time * gait.posesPerCycle));
  const [before, after] = [Math.floor(place), Math.min(last, Math.floor(place) + 1)];
  const part = place - before;
  return Float32Array.from({ length: size }, (_, i) => {
    const [from, to] = [gait.coordinates[before * size + i] ?? 0, gait.coordinates[after * size + i] ?? 0];
    return (from + (to - from) * part) / 100;
  });
}

/** The part of a body that never changes while it walks. */
export interface Looking { voxels: Voxel[]; looks: Look[]; height: number }

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
    const lane = { left: 0, top: 0, width, height, ground, scale, camera: this.#camera };
    drawGround(pen, lane, colors.value, false);
    drawRobot(pen, outline, this.looking.voxels, this.looking.looks, lane, colors.value);
  }
}
