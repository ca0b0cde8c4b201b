// A bus that may be a picture is one to draw on.

import assert from "node:assert/strict";
import { test } from "node:test";

import { opened } from "./opened.mjs";

const DOTS = `circuit dots(pixels[49]) -> (top, last) {
    top  = pixels[48] and pixels[47]
    last = pixels[0]
}
`;

const here = opened({ "dots.nb": DOTS }, "dots.nb");

test("a stroke sets pixels, and the swarm reads them", async () => {
  const { page } = here;
  const place = async name => {
    const { x, y, width, height } = await page.locator(`[data-pixel="${name}"]`).boundingBox();
    return [x + width / 2, y + height / 2];
  };
  await page.mouse.move(...(await place("pixels[48]")));
  await page.mouse.down();
  await page.mouse.move(...(await place("pixels[47]")));
  await page.mouse.up();
  await page.mouse.move(...(await place("pixels[20]")));
  const drawn = page.locator('.drawn [aria-checked="true"]');
  assert.deepEqual(await drawn.evaluateAll(pixels => pixels.map(pixel => pixel.dataset.pixel)), [
    "pixels[48]",
    "pixels[47]",
  ]);
  await page.locator('[data-lamp="top"][data-value="1"]').waitFor();
  const { width, height } = await page.locator(".drawn").boundingBox();
  assert.ok(Math.abs(width - height) < 2 && width < 300, `${width} x ${height}`);
  // A stroke that begins on ink takes it away.
  await page.mouse.move(...(await place("pixels[47]")));
  await page.mouse.down();
  await page.mouse.up();
  await page.locator('[data-lamp="top"][data-value="0"]').waitFor();
});

test("arrows choose a pixel, and the space bar changes it", async () => {
  const { page } = here;
  await page.locator('[data-pixel="pixels[48]"]').focus();
  for (const key of ["ArrowDown", "ArrowRight", " "]) {
    await page.keyboard.press(key);
  }
  await page.locator('[data-pixel="pixels[40]"][aria-checked="true"]').waitFor();
});

test("on a phone the image is within the page", async () => {
  const { page } = here;
  await page.setViewportSize({ width: 360, height: 740 });
  const right = await page.locator(".drawn").evaluate(image => image.getBoundingClientRect().right);
  assert.ok(right <= 360, `it ends at ${right}`);
  assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 360);
});
