// Exported pages: files that play without a server and without a network, and compute what the circuits do.

import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { readFileSync, statSync } from "node:fs";
import { readFile } from "node:fs/promises";
import path from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { promisify } from "node:util";

import { closeBrowser, cyclesLater, lampsShow, setInput, visit, walking } from "./browser.mjs";
import { LATCH, folderWith, play } from "./program.mjs";

const run = promisify(execFile);
const PROGRAM = path.resolve(process.env.NBC);
const circuit = name => new URL(`../../circuits/${name}.nb`, import.meta.url);
const here = {};

before(() => {
  here.place = folderWith({ "latch.nb": LATCH });
});

after(async () => {
  await closeBrowser();
  here.place?.remove();
});

/** Exports a circuit of the gallery, and opens the file without a network. */
async function exported(name, options = [], context = {}) {
  const file = path.join(here.place.folder, `${name}.html`);
  await run(PROGRAM, ["play", circuit(name).pathname, "--export", file, ...options]);
  const page = await visit(pathToFileURL(file).href, { offline: true, ...context });
  await walking(page);
  return Object.assign(page, { file });
}

async function runTests(page) {
  const tests = await page.locator(".checks .test").all();
  for (const one of tests) {
    await one.locator("summary").click();
    await one.locator("[data-do=test]").click();
    const verdict = await one.locator(".verdict").textContent();
    const [, passed, all] = /^(\d+) of (\d+) rows/.exec(verdict) ?? [];
    assert.ok(passed === all && Number(all) > 0, verdict);
  }
  return tests.length;
}

for (const name of ["latch", "full_adder", "ripple_adder", "counter", "t_flip_flop", "sr_latch", "traffic_light"]) {
  test(`the exported page of ${name} agrees with the tests of its file`, async () => {
    const page = await exported(name);
    assert.ok((await runTests(page)) > 0);
    await page.leave();
  });
}

test("the latch is small, follows its switches, and loads nothing", async () => {
  const page = await exported("latch");
  const requests = [];
  page.on("request", request => requests.push(request.url()));
  assert.ok(statSync(page.file).size < 500_000, `${statSync(page.file).size} bytes`);
  await page.locator(".speed").selectOption("16×");
  for (const [d, e, q] of [
    [1, 1, 1],
    [1, 0, 1],
    [0, 0, 1],
    [0, 1, 0],
    [0, 0, 0],
    [1, 0, 0],
  ]) {
    await setInput(page, "d", d);
    await setInput(page, "e", e);
    await cyclesLater(page, 12);
    await lampsShow(page, { q, nq: 1 - q });
  }
  assert.equal(await page.locator('.schematic [data-id="net-q"].zero').count(), 1);
  assert.match(
    await page.locator(".about").textContent(),
    /^Made by nbc \d+\.\d+\.\d+ from latch\.nb\. This page is a recording/,
  );
  assert.deepEqual(requests, []);
  const policy = await page.locator('meta[http-equiv="Content-Security-Policy"]').getAttribute("content");
  assert.match(
    policy,
    /^default-src 'none'; script-src 'sha256-[^']+'; style-src 'sha256-[^']+'; img-src data: blob:;/,
  );
  const reached = await page.evaluate(() =>
    fetch("http://127.0.0.1:1/").then(
      () => "reached",
      error => error.name,
    ),
  );
  assert.equal(reached, "TypeError");
  const errors = await page.evaluate(() => document.querySelectorAll(".empty").length);
  assert.equal(errors, 0);
  // The browser reports the request that the policy has refused.
  await page.leave().catch(error => assert.match(String(error), /Content Security Policy|fetch/));
});

test("it pauses, steps, goes back to the start, and knows the keys", async () => {
  const page = await exported("latch");
  const cycle = async () => Number(/\d+/.exec(await page.locator(".cycle").textContent())[0]);
  await page.locator("body").press("Space");
  await page.locator('[data-do=play][data-running="false"]').waitFor();
  const before = await cycle();
  await page.locator("[data-do=step]").click();
  await page.waitForFunction(want => document.querySelector(".cycle").textContent === `cycle ${want}`, before + 1);
  // A button keeps the keys for itself.
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press(".");
  await page.waitForFunction(want => document.querySelector(".cycle").textContent === `cycle ${want}`, before + 2);
  await page.locator("[data-do=reset]").click();
  await page.waitForFunction(() => document.querySelector(".cycle").textContent === "cycle 0");
  await page.locator("[data-do=theme]").click();
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "dark");
  await page.leave();
});

test("the truth table of an adder is beside its robots and sets its inputs", async () => {
  const page = await exported("full_adder");
  const rows = await page
    .locator(".table tbody tr")
    .evaluateAll(all => all.map(row => row.textContent.replace("▸", "")));
  assert.deepEqual(rows, ["00000", "00110", "01010", "01101", "10010", "10101", "11001", "11111"]);
  await page.locator('.table [data-row="110"] button').click();
  await page.locator('.table [data-row="110"][aria-current]').waitFor();
  await lampsShow(page, { sum: 0, cout: 1 });
  await page.leave();
});

test("a wave machine counts its steps", async () => {
  const page = await exported("wave_counter", ["--swarm", "sturdy_wave"]);
  assert.equal(await page.locator(".checks").count(), 0);
  await page.locator("[data-do=play]").click();
  const output = () => page.locator('[data-output="count"]').textContent();
  await page.locator("[data-do=reset]").click();
  // Else the cycle of before could be that after the first step.
  await page.waitForFunction(
    () =>
      /^\D*0$/.test(document.querySelector(".cycle").textContent) &&
      document.querySelector("[data-do=play]").dataset.running === "false",
  );
  const seen = [];
  for (let step = 0; step < 14; step++) {
    const now = await page.locator(".cycle").textContent();
    await page.locator("[data-do=wave-step]").click();
    await page.waitForFunction(
      text =>
        document.querySelector(".cycle").textContent !== text &&
        document.querySelector("[data-do=play]").dataset.running === "false",
      now,
    );
    await page.waitForTimeout(700);
    seen.push(Number(await output()));
  }
  // Its first steps are those of the start.
  const first = seen.indexOf(2);
  assert.ok(first >= 0 && first < 7, seen.join());
  assert.deepEqual(
    seen.slice(first),
    seen.slice(first).map((_, i) => (2 + i) % 8),
    seen.join(),
  );
  await page.leave();
});

test("on a phone it is as wide as the screen, and in the dark as dark", async () => {
  const page = await exported("latch", [], { viewport: { width: 390, height: 844 }, colorScheme: "dark" });
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "dark");
  const top = selector => page.locator(selector).evaluate(part => part.getBoundingClientRect().top);
  assert.ok((await top(".player .stage")) < (await top(".checks")), "the robots come first");
  await page.leave();
});

test("the page of nbc play makes the same file", async () => {
  const program = await play(here.place.folder, "latch.nb");
  const page = await visit(program.url);
  await walking(page);
  await page.locator(".take summary").click();
  const waiting = page.waitForEvent("download");
  await page.locator('[data-take="player"]').click();
  const download = await waiting;
  assert.equal(download.suggestedFilename(), "d_latch-recorded.html");
  const made = await readFile(await download.path(), "utf8");
  const file = path.join(here.place.folder, "command.html");
  await run(PROGRAM, ["play", path.join(here.place.folder, "latch.nb"), "--export", file]);
  assert.ok(made === readFileSync(file, "utf8"), "byte for byte");
  await page.leave();
  await program.stop();
});
