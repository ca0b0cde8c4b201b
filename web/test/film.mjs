// Films the page for the manual, and takes pictures of its parts. Writes docs/play/.

import { execFileSync } from "node:child_process";
import { mkdirSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

import gifenc from "gifenc";
import { PNG } from "pngjs";

import { closeBrowser, cyclesLater, setInput, visit, walking } from "./browser.mjs";
import { LATCH, folderWith, play } from "./program.mjs";

const CIRCUITS = fileURLToPath(new URL("../../circuits/", import.meta.url));

const { GIFEncoder, applyPalette, quantize } = gifenc;

const SIZE = { width: 1120, height: 760 };
const FRAMES = 72;
/** Milliseconds from frame to frame. */
const DELAY = 125;
/** The frames at which an input is set: with e on, q follows d; then e goes off, and q stays. */
const FLIPS = new Map([
  [6, ["e", 1]],
  [20, ["d", 1]],
  [40, ["e", 0]],
  [54, ["d", 0]],
]);
/** The color that leaves a pixel as it was. */
const SAME = 0;

async function shots(page) {
  const frames = [];
  const start = Date.now();
  for (let i = 0; i < FRAMES; i++) {
    if (FLIPS.has(i)) {
      await setInput(page, ...FLIPS.get(i));
    }
    await page.waitForTimeout(Math.max(0, start + i * DELAY - Date.now()));
    frames.push(PNG.sync.read(await page.screenshot()).data);
  }
  return frames;
}

/** One palette for all frames, and of each frame only the pixels that have changed. */
function encode(frames) {
  const sample = Buffer.concat([frames[0], frames[FRAMES >> 1], frames[FRAMES - 1]]);
  const palette = [[0, 0, 0], ...quantize(sample, 127)];
  const gif = GIFEncoder();
  let before;
  for (const frame of frames) {
    const now = applyPalette(frame, palette.slice(1)).map(color => color + 1);
    const shown = before === undefined ? now : now.map((color, at) => (color === before[at] ? SAME : color));
    gif.writeFrame(shown, SIZE.width, SIZE.height, {
      palette: before === undefined ? palette : undefined,
      delay: DELAY,
      transparent: true,
      transparentIndex: SAME,
      dispose: 1,
    });
    before = now;
  }
  gif.finish();
  return gif.bytes();
}

/** Where a picture of the manual is. */
function place(name) {
  return fileURLToPath(new URL(`../../docs/play/${name}`, import.meta.url));
}

/** The latch, whose inputs are flipped. */
async function film(url) {
  const page = await visit(url, { viewport: SIZE });
  await walking(page);
  const bytes = encode(await shots(page));
  writeFileSync(place("latch.gif"), bytes);
  console.log(`latch.gif: ${bytes.length} bytes`);
  await page.leave();
}

/** The designer with a NAND, and a lesson, in the dark. */
async function pictures(url) {
  const page = await visit(url, { viewport: { width: 1280, height: 860 }, colorScheme: "dark" });
  await walking(page);
  await page.locator("#tab-robots").click();
  await page.locator("[data-robot=nand_5x5] [data-do=design]").first().click();
  await page.locator('.probe[data-letters="RRRL"]:not([data-waiting])').waitFor();
  await page.locator(".probe .facts").getByText("1 cycle").waitFor();
  await page.screenshot({ path: place("designer.png") });
  await page.locator("#tab-learn").click();
  await page.screenshot({ path: place("learn.png") });
  await page.leave();
}

/** The processor: all its robots at once. */
async function processor(url) {
  const page = await visit(url, { viewport: { width: 1800, height: 1400 } });
  await page.locator(".circuit option").first().waitFor({ state: "attached" });
  await page.waitForFunction(() => /^\d{3} robots/.test(document.querySelector(".swarm .status").textContent));
  await walking(page);
  await page.locator('[data-do="crowd"]').click();
  await cyclesLater(page, 3);
  await page.locator(".swarm .scene").screenshot({ path: place("crowd.png") });
  await page.leave();
}

/** The recorded tests of an adder as a page of its own. */
async function exported(folder) {
  const file = join(folder, "full_adder.html");
  execFileSync(resolve(process.env.NBC), ["play", "full_adder.nb", "--export", file], { cwd: CIRCUITS });
  const page = await visit(pathToFileURL(file).href, { viewport: { width: 1280, height: 860 }, offline: true });
  await page.locator(".sheet svg").first().waitFor();
  await page.screenshot({ path: place("recorded.png"), fullPage: true });
  await page.leave();
}

// The page shows the name of the folder.
const { folder, remove } = folderWith({});
const circuits = join(folder, "circuits");
mkdirSync(circuits);
writeFileSync(join(circuits, "latch.nb"), LATCH);
const server = await play(circuits, "latch.nb");
await film(server.url);
await pictures(server.url);
const large = await play(CIRCUITS, "riscv.nb");
await processor(large.url);
await exported(folder);
await large.stop();
await closeBrowser();
await server.stop();
remove();
