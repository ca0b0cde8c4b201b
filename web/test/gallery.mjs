// Draws a picture of each example for the page, its schematic without its words: writes gallery.json.

import { execFileSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { fileURLToPath } from "node:url";

import { closeBrowser, visit } from "./browser.mjs";

const CIRCUITS = fileURLToPath(new URL("../../circuits/", import.meta.url));
/** What to draw of a file with several circuits or swarms. */
const CHOSEN = {
  "three_computer.nb": ["--swarm", "fibonacci_three"],
  "three_senses.nb": ["--swarm", "few_adder"],
  "wave_computer.nb": ["--swarm", "fibonacci_waves"],
  "wave_counter.nb": ["--swarm", "quick_wave"],
};
const SIZE = { width: 192, height: 120 };

/** The widest part of a drawing that is shown: its robots can still be seen. */
const MOST = 1400;

/** In a document: the drawing of a schematic, cropped to its wires and robots or to the middle of these, as an image. */
async function shrunk({ text, width, height, most }) {
  document.body.innerHTML = text;
  const svg = document.querySelector("svg");
  svg.querySelectorAll(":scope > text, :scope > line, :scope > rect").forEach(part => part.remove());
  const { x, y, width: wide, height: high } = svg.getBBox();
  const across = Math.min(most, wide);
  const down = Math.min((most * height) / width, high);
  svg.setAttribute("viewBox", [x + (wide - across) / 2 - 4, y + (high - down) / 2 - 4, across + 8, down + 8].join(" "));
  svg.setAttribute("width", width * 4);
  svg.setAttribute("height", height * 4);
  const image = new Image();
  image.src = `data:image/svg+xml;utf8,${encodeURIComponent(new XMLSerializer().serializeToString(svg))}`;
  await image.decode();
  const canvas = Object.assign(document.createElement("canvas"), { width, height });
  const pen = canvas.getContext("2d");
  pen.imageSmoothingQuality = "high";
  pen.fillStyle = "#fff";
  pen.fillRect(0, 0, width, height);
  pen.drawImage(image, 0, 0, width, height);
  return canvas.toDataURL("image/webp", 0.6);
}

const folder = mkdtempSync(path.join(tmpdir(), "nbc-gallery-"));
const page = await visit("about:blank");
const pictures = {};
for (const name of readdirSync(CIRCUITS).filter(name => name.endsWith(".nb"))) {
  const drawing = path.join(folder, `${name}.svg`);
  const options = ["--as", "schematic", "--output", drawing, ...(CHOSEN[name] ?? [])];
  execFileSync(path.resolve(process.env.NBC), ["draw", path.join(CIRCUITS, name), ...options]);
  pictures[name] = await page.evaluate(shrunk, { text: readFileSync(drawing, "utf8"), ...SIZE, most: MOST });
}
writeFileSync(fileURLToPath(new URL("../gallery.json", import.meta.url)), `${JSON.stringify(pictures, null, 1)}\n`);
await page.leave();
await closeBrowser();
rmSync(folder, { recursive: true });
