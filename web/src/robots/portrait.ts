// A body at rest.

import type { PaletteEntry, VoxelLook } from "../protocol";
import { colors } from "../theme";
import { EMPTY, sizeOf, type Body } from "./body";

/** The look of each code of a palette. */
export function looksByCode(looks: VoxelLook[], palette: PaletteEntry[]): Map<string, VoxelLook> {
  return new Map(
    palette.flatMap(({ code, look }): [string, VoxelLook][] => {
      const found = looks[look];
      return code === EMPTY || found === undefined ? [] : [[code, found]];
    }),
  );
}

/** Draws a body in the middle of a canvas, standing on its lower edge. */
export function drawBody(canvas: HTMLCanvasElement, body: Body, looks: VoxelLook[], palette: PaletteEntry[]): void {
  const ratio = devicePixelRatio || 1;
  canvas.width = Math.round(canvas.clientWidth * ratio);
  canvas.height = Math.round(canvas.clientHeight * ratio);
  const pen = canvas.getContext("2d");
  if (pen === null) {
    return;
  }
  const byCode = looksByCode(looks, palette);
  const [width, height] = sizeOf(body);
  const side = Math.min(canvas.height / (height + 1), canvas.width / (width + 1));
  pen.strokeStyle = colors.value.edge;
  body.forEach((row, y) =>
    [...row].forEach((code, x) => {
      const look = byCode.get(code);
      if (look !== undefined) {
        const place: [number, number] = [
          (canvas.width - width * side) / 2 + x * side,
          canvas.height - (height - y) * side,
        ];
        pen.fillStyle = look.color;
        pen.fillRect(...place, side, side);
        pen.strokeRect(...place, side, side);
      }
    }),
  );
}
