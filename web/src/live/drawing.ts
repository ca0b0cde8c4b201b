// Robots on a canvas: colored voxels on a ground with a tick for each voxel.

import type { SwarmRobot, VoxelLook } from "../protocol";
import type { Colors } from "../colors";
import type { Outline } from "./playback";
import { threadColor } from "./waves";

export interface Lane {
  left: number;
  top: number;
  width: number;
  height: number;
  ground: number;
  scale: number;
  /** The voxel in the middle. */
  camera: number;
  /** The columns of the ground, which repeat: the rows from and up to which each is voxels; none if it is flat. */
  columns: number[][];
}

type Pen = CanvasRenderingContext2D;
type Point = [number, number];
/** The corners of a voxel, around it from the top left. */
export type Corners = [Point, Point, Point, Point];

export function drawGround(pen: Pen, lane: Lane, colors: Colors): void {
  const { left, top, width, height, ground, scale, camera } = lane;
  pen.fillStyle = colors.sky;
  pen.fillRect(left, top, width, ground - top);
  pen.fillStyle = colors.ground;
  pen.fillRect(left, ground, width, top + height - ground);
  drawColumns(pen, lane, colors);
  pen.fillStyle = colors.tick;
  pen.font = `10px ${colors.font}`;
  pen.textAlign = "center";
  pen.textBaseline = "top";
  const half = width / 2 / scale;
  for (let voxel = Math.ceil(camera - half); voxel <= camera + half; voxel++) {
    const x = Math.round(left + (voxel - camera + half) * scale);
    pen.fillRect(x, ground, 1, voxel % 5 === 0 ? 6 : 3);
    const isWhole = x - left >= 12 && left + width - x >= 12;
    if (voxel % 10 === 0 && isWhole && top + height - ground >= 17) {
      pen.fillText(String(voxel), x, ground + 7);
    }
  }
}

/** The voxels of ground above its lowest row, and the gaps in that row. */
function drawColumns(pen: Pen, lane: Lane, colors: Colors): void {
  const { left, top, width, height, ground, scale, camera, columns } = lane;
  const half = width / 2 / scale;
  for (let voxel = Math.max(0, Math.floor(camera - half)); voxel <= camera + half; voxel++) {
    const ends = columns[voxel % columns.length] ?? [0, 1];
    const from = Math.max(0, Math.round((voxel - camera + half) * scale));
    const wide = Math.min(width, Math.round((voxel + 1 - camera + half) * scale)) - from;
    if (ends[0] !== 0) {
      pen.fillStyle = colors.sky;
      pen.fillRect(left + from, ground, wide, top + height - ground);
    }
    pen.fillStyle = colors.ground;
    for (let i = 0; i + 1 < ends.length; i += 2) {
      const [low, high] = [Math.max(1, ends[i] ?? 0) - 1, (ends[i + 1] ?? 0) - 1];
      pen.fillRect(left + from, ground - high * scale, wide, (high - low) * scale);
    }
  }
}

export function drawRobot(
  pen: Pen,
  outline: Outline,
  voxels: SwarmRobot["voxels"],
  looks: VoxelLook[],
  lane: Lane,
  colors: Colors,
): void {
  const { left, width, ground, scale, camera } = lane;
  const place = (point: number): Point => [
    left + width / 2 + ((outline[2 * point] ?? 0) - camera) * scale,
    ground - (outline[2 * point + 1] ?? 0) * scale,
  ];
  pen.lineWidth = 0.8;
  pen.lineJoin = "round";
  pen.strokeStyle = colors.edge;
  for (const [a, b, c, d, look] of voxels) {
    drawVoxel(pen, [place(a), place(b), place(c), place(d)], looks[look]);
  }
}

export function drawVoxel(pen: Pen, corners: Corners, look: VoxelLook | undefined): void {
  tracePolygon(pen, corners);
  pen.fillStyle = look?.color ?? "#888";
  pen.fill();
  pen.stroke();
  if (look?.mark) {
    drawMark(pen, corners, look.mark, look.ink ?? "#000");
  }
}

/** The sign of a material: polygons within the unit square. */
function drawMark(pen: Pen, [a, b, c, d]: Corners, mark: [number, number][][], ink: string): void {
  const across = (from: number, to: number, share: number): number => from + (to - from) * share;
  pen.fillStyle = ink;
  for (const polygon of mark) {
    const placed = polygon.map(
      ([x, y]): Point => [
        across(across(a[0], b[0], x), across(d[0], c[0], x), y),
        across(across(a[1], b[1], x), across(d[1], c[1], x), y),
      ],
    );
    tracePolygon(pen, placed);
    pen.fill();
  }
}

function tracePolygon(pen: Pen, points: Point[]): void {
  pen.beginPath();
  points.forEach(([x, y], i) => (i === 0 ? pen.moveTo(x, y) : pen.lineTo(x, y)));
  pen.closePath();
}

/** A lamp: a full disk with an arrow to the right for 1, a ring with an arrow to the left for 0. */
export function drawLamp(pen: Pen, value: number | null, x: number, y: number, radius: number, colors: Colors): void {
  pen.lineWidth = Math.max(2, radius / 6);
  pen.beginPath();
  pen.arc(x, y, radius, 0, 2 * Math.PI);
  pen.strokeStyle = pen.fillStyle = value === null ? colors.line : value === 1 ? colors.one : colors.zero;
  if (value === 1) {
    pen.fill();
  }
  pen.stroke();
  if (value === null) {
    return;
  }
  const reach = (value === 1 ? 0.5 : -0.5) * radius;
  pen.fillStyle = value === 1 ? colors.paper : colors.zero;
  tracePolygon(pen, [
    [x + reach, y],
    [x - reach * 0.6, y - radius * 0.5],
    [x - reach * 0.6, y + radius * 0.5],
  ]);
  pen.fill();
}

/** The dial of a robot that counts its own cycles, with the share of the present one that is over. */
export function drawDial(pen: Pen, share: number, x: number, y: number, radius: number, colors: Colors): void {
  pen.lineWidth = 1.5;
  pen.strokeStyle = pen.fillStyle = colors.dim;
  pen.beginPath();
  pen.arc(x, y, radius, 0, 2 * Math.PI);
  pen.stroke();
  pen.beginPath();
  pen.moveTo(x, y);
  pen.arc(x, y, radius - 2.5, -Math.PI / 2, (2 * share - 0.5) * Math.PI);
  pen.fill();
}

/** A square for a stimulus, filled while it is present. */
export function drawStimulus(
  pen: Pen,
  value: number | null,
  x: number,
  y: number,
  size: number,
  colors: Pick<Colors, "one" | "dim">,
): void {
  pen.lineWidth = 1.5;
  pen.strokeStyle = value === 1 ? colors.one : colors.dim;
  pen.strokeRect(x + 0.75, y + 0.75, size - 1.5, size - 1.5);
  if (value === 1) {
    pen.fillStyle = colors.one;
    pen.fillRect(x + 3, y + 3, size - 6, size - 6);
  }
}

/** A strip of a thread's color at the left of a robot's lane, and the thread's number at the right of its label. */
export function drawThread(
  pen: Pen,
  thread: number,
  area: { left: number; top: number; height: number; right: number },
  size: number,
  colors: Colors,
): void {
  const number = String(thread + 1);
  const { left, top, height, right } = area;
  pen.fillStyle = colors.threads[threadColor(thread) - 1] ?? colors.dim;
  pen.fillRect(left, top, 5, height);
  pen.font = `650 ${12 * size}px ${colors.font}`;
  const width = Math.max(18 * size, pen.measureText(number).width + 8 * size);
  pen.beginPath();
  pen.roundRect(right - width, top + 4, width, 18 * size, 4);
  pen.fill();
  pen.fillStyle = colors.onThread;
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  pen.fillText(number, right - width / 2, top + 4 + 9.5 * size);
}
