// A page in the browser that BROWSER names, Chromium or Firefox. Errors in the page fail the test.

import assert from "node:assert/strict";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { cpus, loadavg } from "node:os";
import path from "node:path";

import { chromium, firefox } from "playwright-core";

import { seedOf } from "./program.mjs";

const FOUND = { chromium: ["/usr/bin/chromium"], firefox: ["/usr/bin/firefox-esr", "/usr/bin/firefox"] };
export const BROWSER = process.env.BROWSER ?? "chromium";
const executablePath =
  process.env[BROWSER.toUpperCase()] ?? FOUND[BROWSER]?.find(place => existsSync(place)) ?? FOUND[BROWSER]?.[0];
if (executablePath === undefined) {
  throw new Error(`BROWSER is ${BROWSER}; expected ${Object.keys(FOUND).join(" or ")}`);
}

/** Whether a test needs what only the protocol of Chromium has: the reason to skip it in another browser. */
export function onlyChromium(what) {
  return BROWSER !== "chromium" && `${BROWSER} is not asked for ${what}`;
}

/** The browsers that are being launched, so that pages which are opened at once share one. */
const browsers = new Map();

/** What Chromium is asked by page, Firefox has in its preferences, so that there is a Firefox for each set of them. */
function launched({ colorScheme, reducedMotion }) {
  const preferences = {
    "dom.events.testing.asyncClipboard": true,
    "layout.css.prefers-color-scheme.content-override": colorScheme === "dark" ? 0 : 1,
    "ui.prefersReducedMotion": reducedMotion === "reduce" ? 1 : 0,
  };
  const key = BROWSER === "firefox" ? JSON.stringify(preferences) : "";
  if (!browsers.has(key)) {
    browsers.set(
      key,
      BROWSER === "firefox"
        ? firefox.launch({ executablePath, channel: "moz-firefox", firefoxUserPrefs: preferences })
        : chromium.launch({ executablePath, args: ["--no-sandbox"] }),
    );
  }
  return browsers.get(key);
}

export async function closeBrowser() {
  await Promise.all([...browsers.values()].map(async one => (await one).close()));
  browsers.clear();
}

/** Opens an address in a context of its own, with an empty memory. `script` runs in each document first. */
export async function visit(url, { script, ...options } = {}) {
  const given = { viewport: { width: 1440, height: 900 }, ...options };
  if (BROWSER === "firefox") {
    ["permissions", "isMobile"].forEach(name => delete given[name]);
  }
  const context = await (await launched(options)).newContext(given);
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
  for (const first of [script, BROWSER === "firefox" ? rememberSaved : undefined]) {
    await (first && page.addInitScript(first));
  }
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

/** Says how long something took in milliseconds, and fails if that is too long, unless others need the processors. */
export function within(t, what, took, most) {
  const [load] = loadavg();
  const said = `${what} after ${Math.round(took)} ms, at a load of ${load.toFixed(1)}`;
  t.diagnostic(said);
  assert.ok(took < most || load > 2 * cpus().length, said);
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

/** Types a number in place of the one in a field, key by key as a person does. */
export async function typeNumber(field, number) {
  await field.fill("");
  await field.pressSequentially(String(number));
}

/** In a document: remembers the last file that the page has made itself and saves, of which Firefox does not tell. */
function rememberSaved() {
  const made = new Map();
  const create = URL.createObjectURL;
  URL.createObjectURL = blob => {
    const url = create.call(URL, blob);
    made.set(url, blob);
    return url;
  };
  const remember = ({ target: { download: name, href } }) => {
    const file = made.get(href);
    if (file !== undefined) {
      const reader = new FileReader();
      reader.onload = () => (window.savedFile = { name, data: reader.result.replace(/^.*,/, "") });
      reader.readAsDataURL(file);
    }
  };
  addEventListener("click", remember, true);
}

/** The name and the bytes of the file that a press saves. */
export async function taken(page, press) {
  const coming = page.waitForEvent("download").then(async download => {
    assert.equal(await download.failure(), null);
    return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
  });
  const made = async () => {
    const file = await (await page.waitForFunction(() => window.savedFile)).jsonValue();
    await page.evaluate(() => delete window.savedFile);
    return { name: file.name, bytes: Buffer.from(file.data, "base64") };
  };
  const all = BROWSER === "firefox" ? [coming, made()] : [coming];
  await press();
  const file = await Promise.any(all);
  // That which does not come is not missed.
  all.forEach(one => one.catch(() => {}));
  return file;
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
