// A robot that walks through a part of a canvas, and the camera that follows it.

import type { Colors } from "../colors";
import type { SwarmRobot, VoxelLook } from "../protocol";
import { followWithSlack, middleOf } from "./camera";
import { drawGround, drawRobot } from "./drawing";
import type { Pen } from "./pane";
import type { Outline } from "./playback";

export interface Area {
  left: number;
  top: number;
  width: number;
  height: number;
}

export interface Walking {
  outline: Outline | null;
  voxels: SwarmRobot["voxels"];
  looks: VoxelLook[];
  /** The voxels for which there is room above each other, and at least beside each other. */
  tall: number;
  wide: number;
  /** The columns of the ground, as a lane has them. */
  columns: number[][];
}

/** Draws a robot on its ground, and gives the place of the camera, which was at `camera` before. */
export function drawWalk(
  pen: Pen,
  area: Area,
  { outline, voxels, looks, tall, wide, columns }: Walking,
  camera: number | undefined,
  colors: Colors,
): number {
  const highest = tall + Math.max(0, ...columns.map(ends => (ends.at(-1) ?? 1) - 1));
  const ground = area.top + area.height - Math.min(20, Math.max(9, area.height / 6));
  const scale = Math.min((ground - area.top) / (highest * 1.3), area.width / wide);
  const slack = area.width / scale / 6;
  const followed = followWithSlack(camera, outline === null ? 0 : middleOf(outline), slack);
  const lane = { ...area, ground, scale, camera: followed, columns };
  pen.save();
  pen.beginPath();
  pen.rect(area.left, area.top, area.width, area.height);
  pen.clip();
  drawGround(pen, lane, colors);
  if (outline !== null) {
    drawRobot(pen, outline, voxels, looks, lane, colors);
  }
  pen.restore();
  return followed;
}
