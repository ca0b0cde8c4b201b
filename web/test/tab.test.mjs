// The page that needs no program, from a plain server of files and as a file of its own. NBC_SITE names its folder.

import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";

import {
  BROWSER,
  closeBrowser,
  cyclesLater,
  lampsShow,
  setInput,
  taken,
  typeProgram,
  visit,
  walking,
  within,
} from "./browser.mjs";
import { serveFiles } from "./files.mjs";
import { SITE } from "./program.mjs";

const skip = SITE === undefined && "NBC_SITE does not name the page that `.ci/site` makes";
let site;

before(async () => {
  site = skip ? undefined : await serveFiles(SITE, { sub: "/some/folder" });
});
after(async () => {
  await closeBrowser();
  await site?.stop();
});

/** The latch remembers, in physics that is computed in the page. */
async function remembers(page) {
  await walking(page);
  await setInput(page, "d", 1);
  await setInput(page, "e", 1);
  await lampsShow(page, { q: 1, nq: 0 });
  await setInput(page, "e", 0);
  await cyclesLater(page, 6);
  await setInput(page, "d", 0);
  await cyclesLater(page, 6);
  await lampsShow(page, { q: 1, nq: 0 });
}

test("a stranger has a live latch, in a folder of any server of files", { skip }, async t => {
  const page = await visit(site.address);
  await walking(page);
  // By the page's own clock, which begins with the address: starting the browser is no part of it.
  within(t, "the first cycle", await page.evaluate(() => performance.now()), 2000);
  // The first switch that one flips matters.
  await setInput(page, "d", 1);
  await lampsShow(page, { q: 1, nq: 0 });
  await remembers(page);
  await page.leave();
});

test("files are kept over reloads, and the page opens without a network", { skip }, async () => {
  const page = await visit(`${site.address}`);
  await walking(page);
  await typeProgram(page, "circuit mine(a, b) -> (q) {\n    q = a and b\n}\n");
  await page.waitForFunction(() => document.querySelector(".crumbs").textContent.includes("mine"));
  await page.locator('[data-do="save"]').click();
  await page.locator("dialog.ask input").fill("mine.nb");
  await page.locator('[data-do="save-as"]').click();
  await page.waitForFunction(() => location.hash === "#mine.nb");
  await page.waitForFunction(() => navigator.serviceWorker.controller !== null);
  await page.context().setOffline(true);
  await page.reload();
  await page.waitForFunction(() => document.querySelector(".crumbs")?.textContent.includes("mine"));
  await walking(page);
  await page.context().setOffline(false);
  await page.leave();
});

test("a tab says that another has saved its file", { skip }, async () => {
  const page = await visit(site.address);
  await walking(page);
  const save = async text => {
    await typeProgram(page, text);
    await page.locator('[data-do="save"]').click();
  };
  await save("circuit first(a, b) -> (q) {\n    q = a and b\n}\n");
  await page.locator("dialog.ask input").fill("both.nb");
  await page.locator('[data-do="save-as"]').click();
  await page.waitForFunction(() => location.hash === "#both.nb");
  const other = await page.context().newPage();
  await other.goto(`${site.address}#both.nb`);
  await other.waitForFunction(() => document.querySelector(".crumbs")?.textContent.includes("first"));
  await save("circuit second(a, b) -> (q) {\n    q = a or b\n}\n");
  await other.getByText("both.nb was changed by another program").waitFor();
  await page.leave();
});

/** Begins a program of that name, and saves it. */
async function saved(page, name) {
  await page.locator('[data-do="open"]').click();
  await page.getByLabel("Name of the new file").fill(name);
  await page.locator('[data-do="new"]').click();
  await page.locator('[data-do="save"]').click();
  await page.locator('[data-do="save-as"]').click();
  await page.waitForFunction(want => document.querySelector(".file").textContent === want, name);
  await page.waitForFunction(() => document.querySelector('[data-do="save"]').disabled);
}

async function imported(page, file, name = "files.zip") {
  const buffer = Buffer.isBuffer(file) ? file : readFileSync(file);
  await page.locator('[data-do="import"]').setInputFiles({ name, mimeType: "application/zip", buffer });
}

test("the files of the browser go into an archive and come back from it", { skip }, async () => {
  const page = await visit(site.address);
  await walking(page);
  await saved(page, "main.nb");
  await saved(page, "größe/逻辑.nb");
  await page.locator('[data-do="open"]').click();
  const { name, bytes: archive } = await taken(page, () => page.locator('[data-do="export"]').click());
  assert.match(name, /^nbc-files-\d{8}-\d{6}\.zip$/);
  await page.leave();

  const other = await visit(site.address);
  await walking(other);
  await other.locator('[data-do="open"]').click();
  await imported(other, archive.subarray(0, 99));
  await other.getByText("Cannot import files.zip: this is not a zip archive, or it is damaged.").waitFor();
  await imported(other, archive);
  await other.getByText("2 files imported.").waitFor();
  await other.locator('[data-open="größe/逻辑.nb"]').click();
  await other.waitForFunction(() => document.querySelector(".file").textContent === "größe/逻辑.nb");
  await typeProgram(other, "circuit own(a, b) -> (q) {\n    q = a nor b\n}\n");
  await other.locator('[data-do="save"]').click();
  await other.locator('.file[data-unsaved="false"]').waitFor();
  // What is there already is not replaced without a question.
  await other.locator('[data-do="open"]').click();
  await imported(other, archive);
  await other.getByText("Other files of these names are there already: größe/逻辑.nb.").waitFor();
  await other.locator('[data-do="keep-files"]').click();
  await other.getByText("1 file imported.").waitFor();
  await imported(other, archive);
  await other.locator('[data-do="replace-files"]').click();
  await other.keyboard.press("Escape");
  await other.locator("[data-notice=changed]").getByText("größe/逻辑.nb was changed by another program").waitFor();
  // They are kept over a reload.
  await other.reload();
  await walking(other);
  await other.locator('[data-do="open"]').click();
  await other.locator('[data-open="main.nb"]').click();
  await other.locator(".cm-content").getByText("circuit mine").waitFor();
  await other.leave();
});

test("while a robot is measured the page answers, and the measurement can be stopped", { skip }, async () => {
  const page = await visit(site.address);
  await walking(page);
  await page.locator("#tab-robots").click();
  await page.locator("[data-robot=nand_5x5] [data-do=design]").first().click();
  await page.locator(".keeping input").fill("mine");
  await page.locator("[data-do=keep]").click();
  await page.getByText("measuring it over").waitFor();
  await page.locator("[data-do=evolve]").click();
  await typeProgram(page, "circuit broken(a) -> (q) {\n    q = b\n}\n");
  await page.locator(".cm-lintRange-error").waitFor();
  await page.locator('.swarm .status[data-state="errors"]').waitFor({ state: "attached" });
  await page.locator("[data-do=stop-keep]").click();
  await page.getByText("nothing was kept").waitFor();
  await page.locator("[data-do=evolve]").click();
  await page.getByRole("button", { name: "Evolve from here" }).waitFor();
  await page.leave();
});

test("at a slow network the page is there at once and says what it waits for", { skip }, async () => {
  const slow = await serveFiles(SITE, { rate: 50_000 });
  const page = await visit(slow.address, { waitUntil: "commit" });
  await page.getByText(/Loading the simulator: \d+ % of/).waitFor();
  await page.leave();
  await slow.stop();
});

/** Lets the worker of a page fail, or, where a browser does not let others into workers, lets the page hear so. */
async function fails(page) {
  if (BROWSER === "chromium") {
    await page.workers()[0].evaluate(() => {
      setTimeout(() => {
        throw new Error("it fails");
      });
    });
  } else {
    await page.evaluate(() => window.firstWorker.dispatchEvent(new ErrorEvent("error", { message: "it fails" })));
  }
}

/** In a document: remembers its first worker. */
function rememberWorker() {
  const own = window.Worker;
  window.Worker = function (...given) {
    const worker = new own(...given);
    window.firstWorker ??= worker;
    return worker;
  };
}

test("a program that fails is started again with the text of the page", { skip }, async () => {
  const page = await visit(site.address, { script: rememberWorker });
  await walking(page);
  await typeProgram(page, "circuit kept(a, b) -> (q) {\n    q = a or b\n}\n");
  await page.waitForFunction(() => document.querySelector(".crumbs").textContent.includes("kept"));
  await fails(page);
  await page.waitForFunction(() => document.querySelector(".banner")?.hidden === false);
  await page.locator(".banner").waitFor({ state: "hidden" });
  await cyclesLater(page, 3);
  await page.leave();
});

test("a live export works from a disk", { skip }, async t => {
  const page = await visit(site.address);
  await walking(page);
  await page.locator(".take summary").click();
  const { bytes } = await taken(page, () => page.locator('[data-take="live"]').click());
  const folder = mkdtempSync(path.join(tmpdir(), "nbc-tab-"));
  const file = path.join(folder, "latch.html");
  writeFileSync(file, bytes);
  await page.leave();
  t.diagnostic(`${bytes.length} bytes`);
  assert.ok(bytes.length < 4_000_000, `${bytes.length} bytes`);
  const address = pathToFileURL(file).href;
  const alone = await visit(address);
  await remembers(alone);
  await typeProgram(alone, "circuit other(a, b) -> (q) {\n    q = a xor b\n}\n");
  await alone.waitForFunction(() => document.querySelector(".crumbs").textContent.includes("other"));
  await alone.leave();
  rmSync(folder, { recursive: true });
});
