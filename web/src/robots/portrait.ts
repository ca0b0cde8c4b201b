// A body at rest.

import { drawVoxel, type Corners } from "../live/drawing";
import type { PaletteEntry, RobotCard, VoxelLook } from "../protocol";
import { colors } from "../colors";
import { EMPTY, sizeOf } from "./body";

export function looksByCode(looks: VoxelLook[], palette: PaletteEntry[]): Map<string, VoxelLook> {
  return new Map(
    palette.flatMap(({ code, look }): [string, VoxelLook][] => {
      const found = looks[look];
      return code === EMPTY || found === undefined ? [] : [[code, found]];
    }),
  );
}

export function drawBody(canvas: HTMLCanvasElement, robot: RobotCard, looks: VoxelLook[]): void {
  const ratio = devicePixelRatio || 1;
  canvas.width = Math.round(canvas.clientWidth * ratio);
  canvas.height = Math.round(canvas.clientHeight * ratio);
  const pen = canvas.getContext("2d");
  if (pen === null) {
    return;
  }
  const { body } = robot;
  const [width, height] = sizeOf(body);
  const voxels = robot.voxels.values();
  const side = Math.min(canvas.height / (height + 1), canvas.width / (width + 1));
  pen.strokeStyle = colors.value.edge;
  body.forEach((row, y) =>
    [...row].forEach((code, x) => {
      if (code !== EMPTY) {
        const [left, top] = [(canvas.width - width * side) / 2 + x * side, canvas.height - (height - y) * side];
        const [right, bottom] = [left + side, top + side];
        const corners: Corners = [
          [left, top],
          [right, top],
          [right, bottom],
          [left, bottom],
        ];
        // Voxels are listed in reading order.
        const look = voxels.next().value?.[4] ?? -1;
        drawVoxel(pen, corners, looks[look]);
      }
    }),
  );
}
