// Measures how soon the page shows something, and how smoothly the robots walk. Prints a line for each swarm.

import { closeBrowser, visit, walking } from "./browser.mjs";
import { LATCH, folderWith, play } from "./program.mjs";

const SECONDS = 5;
const ADDER = "circuit adder(a[40], b[40]) -> (s[40]) {\n    s = a + b\n}\n";
// Two thousand robots.
const WIDE = `circuit wide(a[40], b[50]) -> (y[2000]) {
    for i in 0..50 {
        for j in 0..40 {
            y[40 * i + j] = a[j] xor b[i]
        }
    }
}
`;

/** Frames that the browser draws in a second. */
function frames(page) {
  return page.evaluate(
    seconds =>
      new Promise(done => {
        let count = 0;
        const start = performance.now();
        const next = () => {
          count += 1;
          if (performance.now() - start < 1000 * seconds) {
            requestAnimationFrame(next);
          } else {
            done(count / seconds);
          }
        };
        requestAnimationFrame(next);
      }),
    SECONDS,
  );
}

async function measure(name, text, together = false) {
  const { folder, remove } = folderWith({ [name]: text });
  const program = await play(folder, name);
  const page = await visit(program.url);
  await page.waitForFunction(() => performance.getEntriesByName("first-contentful-paint").length > 0);
  const painted = await page.evaluate(() => performance.getEntriesByName("first-contentful-paint")[0].startTime);
  await walking(page);
  if (together) {
    await page.locator('[data-do="crowd"]').click();
  }
  const walks = await page.evaluate(() => performance.now());
  const rate = await frames(page);
  const robots = /\d+ robots/.exec(await page.locator("body").innerText())?.[0];
  const pace = /[\d.]+ cycles\/s/.exec(await page.locator("body").innerText())?.[0];
  console.log(
    `${name}: ${robots}${together ? " at once" : ""}, first contents after ${Math.round(painted)} ms, walking after ${Math.round(walks)} ms, ` +
      `${rate.toFixed(0)} frames a second at ${pace}`,
  );
  await page.leave();
  await program.stop();
  remove();
}

await measure("latch.nb", LATCH);
await measure("adder.nb", ADDER);
await measure("wide.nb", WIDE);
await measure("wide.nb", WIDE, true);
await closeBrowser();
