// All robots of a swarm at once, each as large as there is room for: with its voxels, as a silhouette, or as a dot.

import { LaneGrid } from "./camera";
import type { Corners } from "./drawing";
import type { Outline } from "./playback";
import type { SwarmRobot } from "../protocol";
import type { Area } from "./walk";

export type Detail = "voxels" | "silhouettes" | "dots";

/** So many times as wide as high is a cell, about. */
const SHAPE = 1.5;
/** Cells are at least so high, and the rest is below. */
const LEAST = 6;
/** Narrower cells have no voxels, and still narrower ones no silhouettes. */
const VOXELS = 64;
const SILHOUETTES = 24;

export function crowdGrid(count: number, width: number, height: number): LaneGrid {
  const columns = Math.max(1, Math.ceil(Math.sqrt((count * width) / Math.max(1, height * SHAPE))));
  return new LaneGrid(count, columns, width, Math.max(LEAST, height / Math.ceil(count / columns)));
}

export function detailOf(grid: LaneGrid): Detail {
  return grid.laneWidth >= VOXELS ? "voxels" : grid.laneWidth >= SILHOUETTES ? "silhouettes" : "dots";
}

type Pen = CanvasRenderingContext2D;

/** A dot that stands to the right for 1 and to the left for 0; `turned` is the part of its way from before. */
export function drawDot(pen: Pen, cell: Area, before: number, now: number, turned: number): void {
  const side = Math.max(2, Math.min(cell.width / 2, cell.height - 2, 14));
  const place = before + (now - before) * turned;
  const left = cell.left + 1 + Math.max(0, cell.width - 2 - side) * place;
  pen.fillRect(left, cell.top + (cell.height - side) / 2, side, side);
}

/** The body in one color, in the middle of its cell, on the cell's lower edge. */
export function drawSilhouette(
  pen: Pen,
  cell: Area,
  outline: Outline,
  voxels: SwarmRobot["voxels"],
  middle: number,
  tall: number,
): void {
  const scale = Math.min(cell.width / (tall * 1.35), cell.height / (tall * 1.1));
  const x = (point: number): number => cell.left + cell.width / 2 + ((outline[2 * point] ?? 0) - middle) * scale;
  const y = (point: number): number => cell.top + cell.height - 1 - (outline[2 * point + 1] ?? 0) * scale;
  pen.beginPath();
  for (const [a, b, c, d] of voxels) {
    const corners = [a, b, c, d].map(point => [x(point), y(point)]) as Corners;
    corners.forEach(([across, up], i) => (i === 0 ? pen.moveTo(across, up) : pen.lineTo(across, up)));
    pen.closePath();
  }
  pen.fill();
}
