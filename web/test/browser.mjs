// A page in Chromium. Errors in the page fail the test.

import assert from "node:assert/strict";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import path from "node:path";

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
  if (begins !== null) {
    await page.route("**/favicon.ico", route => route.fulfill({ status: 204 }));
    await page.goto(begins.at);
    await page.evaluate(putFiles, begins.files);
  }
}

/** In a document of the site: keeps files as another tab does. */
function putFiles(files) {
  return new Promise(done => {
    const opening = indexedDB.open("nbc", 1);
    opening.onupgradeneeded = () => opening.result.createObjectStore("files");
    opening.onsuccess = () => {
      const change = opening.result.transaction("files", "readwrite");
      files.forEach(([name, text]) => change.objectStore("files").put(text, name));
      change.oncomplete = () => {
        opening.result.close();
        const others = new BroadcastChannel("nbc-files");
        files.forEach(file => others.postMessage(file));
        others.close();
        done();
      };
    };
  });
}

/** In a document of the site: the text of a file that the browser keeps. */
function getFile(name) {
  return new Promise(done => {
    const opening = indexedDB.open("nbc", 1);
    opening.onsuccess = () => {
      const reading = opening.result.transaction("files").objectStore("files").get(name);
      reading.onsuccess = () => {
        opening.result.close();
        done(reading.result ?? null);
      };
    };
  });
}

/** The files of the page of `here` (test/opened.mjs), on the disk or in the browser. */
export function filesOf(here) {
  const onDisk = name => path.join(here.place.folder, name);
  const beside = async (work, given) => {
    const other = await here.page.context().newPage();
    await other.goto(seedOf(here.program.url).at);
    const result = await other.evaluate(work, given);
    await other.close();
    return result;
  };
  const isTab = () => seedOf(here.program.url) !== null;
  const read = async name =>
    isTab() ? beside(getFile, name) : existsSync(onDisk(name)) ? readFileSync(onDisk(name), "utf8") : null;
  return {
    read,
    /** Waits until a file has such a text. A browser keeps it soon after the page says that it is saved. */
    has: async (name, text) => {
      for (;;) {
        const found = (await read(name)) ?? "";
        if (text.test(found)) {
          return;
        }
        assert.ok(isTab(), `${name}: ${found}`);
      }
    },
    /** Writes a file as another program or tab does. */
    write: async (name, text) => (isTab() ? beside(putFiles, [[name, text]]) : writeFileSync(onDisk(name), text)),
  };
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
