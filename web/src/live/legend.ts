// What colors and directions mean.

import { element } from "../element";
import type { VoxelLook } from "../protocol";

export function legend(looks: { look: VoxelLook; name: string }[], threads: number): HTMLElement {
  const entry = (sign: HTMLElement, text: string): HTMLElement => element("li", {}, sign, element("span", {}, text));
  const lamp = (value: 0 | 1): HTMLElement =>
    element("span", { class: "lamp", "data-value": value, "aria-hidden": "true" }, String(value));
  const line = (name: string): HTMLElement => element("span", { class: `sample ${name}`, "aria-hidden": "true" });
  const badge = (thread: number): HTMLElement =>
    element("span", { class: "badge", "data-thread": thread, "aria-hidden": "true" }, String(thread));
  return element(
    "details",
    { class: "legend" },
    element("summary", {}, "What colors and directions mean"),
    element(
      "ul",
      {},
      entry(lamp(1), "1: the robot walks right. Blue, full, thick lines."),
      entry(lamp(0), "0: the robot walks left. Orange, hollow, thin lines."),
      entry(line("stimulus on"), "a stimulus that the robot senses is present"),
      entry(line("stimulus"), "it is absent"),
      threads > 1 && entry(badge(2), "the thread of the wave that a robot or a net carries"),
    ),
    element("ul", { class: "materials" }, ...looks.map(({ look, name }) => entry(swatch(look), name))),
  );
}

export function swatch(look: VoxelLook | undefined): HTMLElement {
  const canvas = element("canvas", { class: "swatch", width: 32, height: 32, "aria-hidden": "true" });
  const pen = canvas.getContext("2d");
  if (pen !== null && look !== undefined) {
    pen.fillStyle = look.color;
    pen.fillRect(0, 0, 32, 32);
    pen.fillStyle = look.ink ?? "#000";
    for (const polygon of look.mark ?? []) {
      pen.beginPath();
      polygon.forEach(([x, y], i) => (i === 0 ? pen.moveTo(32 * x, 32 * y) : pen.lineTo(32 * x, 32 * y)));
      pen.fill();
    }
  }
  return canvas;
}
