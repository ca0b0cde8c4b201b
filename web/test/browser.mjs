// A page in Chromium. Errors in the page fail the test.

import assert from "node:assert/strict";

import { chromium } from "playwright-core";

import { seedOf } from "./program.mjs";

const CHROMIUM = process.env.CHROMIUM ?? "/usr/bin/chromium";

/** The browser that is being launched, so that pages which are opened at once share it. */
let browser;

function launched() {
  browser ??= chromium.launch({ executablePath: CHROMIUM, args: ["--no-sandbox"] });
  return browser;
}

export async function closeBrowser() {
  await (await browser)?.close();
  browser = undefined;
}

/** Opens an address in a context of its own, with an empty memory. */
export async function visit(url, options = {}) {
  const context = await (await launched()).newContext({ viewport: { width: 1440, height: 900 }, ...options });
  const page = await context.newPage();
  page.setDefaultTimeout(Number(process.env.PATIENCE ?? 120_000));
  const errors = [];
  page.on("pageerror", error => errors.push(error.stack));
  page.on("console", message => {
    // A lost connection is reported by the browser itself.
    if (message.type() === "error" && !/WebSocket|ERR_CONNECTION/.test(message.text())) {
      errors.push(message.text());
    }
  });
  await seed(page, seedOf(url));
  await page.goto(url);
  return Object.assign(page, {
    leave: async () => {
      await context.close();
      assert.deepEqual(errors, []);
    },
  });
}

/** Puts files into the browser's memory, from a document beside the page. */
async function seed(page, begins) {
  if (begins === null) {
    return;
  }
  await page.route("**/favicon.ico", route => route.fulfill({ status: 204 }));
  await page.goto(begins.at);
  await page.evaluate(
    files =>
      new Promise(done => {
        const opening = indexedDB.open("nbc", 1);
        opening.onupgradeneeded = () => opening.result.createObjectStore("files");
        opening.onsuccess = () => {
          const change = opening.result.transaction("files", "readwrite");
          files.forEach(([path, text]) => change.objectStore("files").put(text, path));
          change.oncomplete = () => {
            opening.result.close();
            done();
          };
        };
      }),
    begins.files,
  );
}

/** Waits until the swarm has been compiled and its run has begun. */
export async function walking(page) {
  await page.waitForFunction(() => Number(/\d+/.exec(document.querySelector(".cycle")?.textContent ?? "")?.[0]) >= 1);
}

export async function cycle(page) {
  return Number(/\d+/.exec((await page.locator(".cycle").textContent()) ?? "")?.[0] ?? 0);
}

/** Waits until this many further cycles have been done. */
export async function cyclesLater(page, count) {
  const goal = (await cycle(page)) + count;
  await page.waitForFunction(
    least => Number(/\d+/.exec(document.querySelector(".cycle")?.textContent ?? "")?.[0]) >= least,
    goal,
  );
}

export async function setInput(page, name, value) {
  const input = page.locator(`button[data-input="${name}"]`);
  if ((await input.getAttribute("aria-checked")) !== String(value === 1)) {
    await input.click();
  }
}

/** The value that the lamp of an output shows. */
export async function lamp(page, name) {
  return Number(await page.locator(`[data-lamp="${name}"]`).getAttribute("data-value"));
}

/** Waits until the lamps of these outputs show these values. */
export async function lampsShow(page, values) {
  await page.waitForFunction(
    wanted =>
      Object.entries(wanted).every(
        ([name, value]) => document.querySelector(`[data-lamp="${name}"]`)?.dataset.value === String(value),
      ),
    values,
  );
}

/** Replaces the text of the editor. */
export async function typeProgram(page, text) {
  await page.locator(".cm-content").click();
  await page.keyboard.press("Control+a");
  await page.keyboard.press("Delete");
  await page.keyboard.insertText(text);
}
