// A second version of the site is deployed while visitors have the first. The server says what most say of their files:
// a date, ten days ago, and nothing about caches.

import assert from "node:assert/strict";
import { cpSync, mkdtempSync, readFileSync, readdirSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, afterEach, beforeEach, test } from "node:test";

import { closeBrowser, taken, typeProgram, visit, walking } from "./browser.mjs";
import { serveFiles } from "./files.mjs";
import { SITE } from "./program.mjs";

const skip = SITE === undefined && "NBC_SITE does not name the page that `.ci/site` makes";
const folders = mkdtempSync(path.join(tmpdir(), "nbc-deploy-"));
let site;

/** The site as another version of its sources would be: its program has another name, and says which version it is. */
function version(number) {
  const folder = path.join(folders, `version-${number}`);
  cpSync(SITE, folder, { recursive: true, filter: from => !from.endsWith("manual") });
  const hashed = /-\w+(?=\.(js|css|bin)$)/;
  const names = readdirSync(folder).filter(name => hashed.test(name));
  names.forEach(name => renameSync(path.join(folder, name), path.join(folder, name.replace(hashed, `-V${number}`))));
  for (const name of readdirSync(folder).filter(name => /\.(js|html)$/.test(name) && !name.startsWith("alone"))) {
    const file = path.join(folder, name);
    let text = readFileSync(file, "utf8").replace(/nbc-[0-9a-f]{16}/g, `nbc-${number}`);
    names.forEach(hash => (text = text.replaceAll(hash, hash.replace(hashed, `-V${number}`))));
    text = text.replace('<html lang="en">', `<html lang="en" data-version="${number}">`);
    text = text.replaceAll("Loading the simulator …", `Loading the simulator of version ${number} …`);
    writeFileSync(file, text);
  }
  return folder;
}

const versions = skip ? [] : [1, 2, 3].map(version);

beforeEach(async () => {
  site = skip ? undefined : await serveFiles(versions[0], { isOld: true });
});
afterEach(async () => {
  await closeBrowser();
  await site?.stop();
});
after(() => rmSync(folders, { recursive: true }));

const shownVersion = page => page.evaluate(() => document.documentElement.dataset.version);
const controlled = page => page.waitForFunction(() => navigator.serviceWorker.controller !== null);

for (const [who, isOffline] of [
  ["a returning visitor", true],
  ["a visitor whose browser keeps no service worker", false],
]) {
  test(`${who} gets the new version and has their files`, { skip }, async () => {
    const options = isOffline ? {} : { serviceWorkers: "block" };
    const page = await visit(site.address, options);
    await walking(page);
    await typeProgram(page, "circuit mine(a, b) -> (q) {\n    q = a and b\n}\n");
    await page.locator('[data-do="save"]').click();
    await page.locator("dialog.ask input").fill("mine.nb");
    await page.locator('[data-do="save-as"]').click();
    await page.waitForFunction(() => location.hash === "#mine.nb");
    await page.locator('.file[data-unsaved="false"]').waitFor();
    if (isOffline) {
      await controlled(page);
    }
    await page.goto("about:blank");
    for (const number of [2, 3]) {
      site.deploy(versions[number - 1]);
      await page.goto(`${site.address}#mine.nb`);
      await page.reload();
      await walking(page);
      assert.equal(await shownVersion(page), String(number));
      await page.locator(".cm-content").getByText("circuit mine").waitFor();
    }
    await page.leave();
  });
}

test("an open tab says that a new version is there, and goes on until it is loaded", { skip }, async () => {
  // Browsers look for a new version when they have little else to do, so no swarm runs.
  const page = await visit(site.address, { reducedMotion: "reduce" });
  const ready = one => one.locator('.swarm .status[data-state="ready"]').waitFor({ state: "attached" });
  await ready(page);
  await controlled(page);
  assert.equal(await page.getByText("A new version is there").count(), 0);
  site.deploy(versions[1]);
  const other = await page.context().newPage();
  await other.goto(site.address);
  await ready(other);
  await page.getByText("A new version is there").waitFor();
  // What it loads only now is that of its version.
  await page.locator("#tab-robots").click();
  await page.locator("[data-robot=nand_5x5] [data-do=design]").first().click();
  await page.locator(".keeping").waitFor();
  assert.equal(await shownVersion(page), "1");
  assert.equal(await other.getByText("A new version is there").count(), 0);
  await page.getByText("A new version is there").click();
  await page.waitForFunction(() => document.documentElement.dataset.version === "2");
  await ready(page);
  await page.leave();
});

test("without a network the page opens, and live pages can be made", { skip }, async () => {
  const page = await visit(site.address);
  await controlled(page);
  await page.waitForFunction(async () => (await caches.keys()).length === 1);
  await page.context().setOffline(true);
  await page.reload();
  await walking(page);
  await page.locator(".take summary").click();
  const { bytes } = await taken(page, () => page.locator('[data-take="live"]').click());
  assert.ok(bytes.length > 2_000_000);
  await page.leave();
});
