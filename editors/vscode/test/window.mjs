// The whole extension in the real editor, without a display: code-server is VS Code's workbench and extension host, and
// a headless Chromium is its window. This takes a minute and installs much, so that only people start it:
//
//     npm install --prefix DIR node@24 code-server puppeteer-core
//     npm run package && WINDOW_TOOLS=DIR node test/window.mjs
//
// DIR needs 1 GB, and installing code-server needs a C++ compiler and libkrb5-dev. CHROMIUM names another browser.
// Pictures of the window are written to build/window.

import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { pathToFileURL } from "node:url";

const tools = path.resolve(process.env.WINDOW_TOOLS ?? "build/tools");
const nbc = path.resolve(process.env.NBC ?? "../../target/release/nbc");
const pictures = path.resolve("build/window");
const modules = path.join(tools, "node_modules");
const entry = pathToFileURL(path.join(modules, "puppeteer-core/lib/esm/puppeteer/puppeteer-core.js"));
const { default: puppeteer } = await import(entry);

const BROKEN = `circuit g(a, b) -> (q) {
    q = a nand bb
}
`;
const GOOD = `circuit inverter(a) -> (q) {
    q = not a
}

test inverter "inverts" {
    a | q
    0 | 1
    1 | 0
}
`;
const FAILING = `circuit g(a, b) -> (q) {
    q = a nand b
}

test g "is a nand" {
    a b | q
    0 0 | 1
    1 1 | 1
}
`;

/** A folder with a workspace, and with an editor of its own. */
const home = mkdtempSync(path.join(tmpdir(), "nbc-window-"));
const workspace = path.join(home, "workspace");

/** Writes the settings of the user or of the workspace. */
function configure(folder, settings) {
  mkdirSync(folder, { recursive: true });
  writeFileSync(path.join(folder, "settings.json"), JSON.stringify(settings));
}

mkdirSync(workspace);
rmSync(pictures, { recursive: true, force: true });
mkdirSync(pictures, { recursive: true });
writeFileSync(path.join(workspace, "good.nb"), GOOD);
writeFileSync(path.join(workspace, "broken.nb"), BROKEN);
writeFileSync(path.join(workspace, "failing.nb"), FAILING);
configure(path.join(home, "user/User"), {
  "nbc.path": nbc,
  "security.workspace.trust.enabled": false,
  "workbench.startupEditor": "none",
  "workbench.secondarySideBar.defaultVisibility": "hidden",
  "telemetry.telemetryLevel": "off",
});

const codeServer = [path.join(modules, "code-server"), "--config", path.join(home, "none.yaml")];
const folders = ["--extensions-dir", path.join(home, "extensions"), "--user-data-dir", path.join(home, "user")];
const node = path.join(modules, ".bin/node");
spawnSync(node, [...codeServer, ...folders, "--install-extension", path.resolve("nb.vsix")], { stdio: "ignore" });
const address = ["--auth", "none", "--bind-addr", "127.0.0.1:0", "--disable-telemetry", "--disable-update-check"];
const server = spawn(node, [...codeServer, ...folders, ...address], { stdio: ["ignore", "pipe", "ignore"] });
const url = await new Promise(resolve => {
  server.stdout.on("data", text => {
    const found = /listening on (http:\S+?)\/?\s/.exec(String(text));
    found && resolve(found[1]);
  });
});

const browser = await puppeteer.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-gpu"],
  defaultViewport: { width: 1400, height: 800 },
  protocolTimeout: 120_000,
});
const page = await browser.newPage();

/** Waits until a function of the page returns something true, and returns it. */
async function until(what, look, ...given) {
  const handle = await page.waitForFunction(look, { timeout: 90_000 }, ...given).catch(async error => {
    await picture("stuck");
    throw new Error(`waited for ${what}: ${error.message}`);
  });
  console.log(`✓ ${what}`);
  return handle.jsonValue();
}

const picture = name => page.screenshot({ path: path.join(pictures, `${name}.png`) });

/** The elements with a text in them. */
const shows = (selector, text) =>
  [...document.querySelectorAll(selector)].some(element => element.textContent.replace(/\s/g, " ").includes(text));

async function keys(...names) {
  for (const name of names) await page.keyboard.down(name);
  for (const name of names.reverse()) await page.keyboard.up(name);
}

/** Types into the box at the top of the window and takes the first offer that has this text. */
async function choose(opener, typed, offered) {
  await keys(...opener);
  await page.waitForSelector(".quick-input-widget input", { visible: true });
  await page.keyboard.type(typed);
  await until(`the offer of ${offered}`, shows, ".quick-input-list .monaco-list-row.focused", offered);
  await page.keyboard.press("Enter");
}

const open = file => choose(["Control", "p"], file, file);
const command = name => choose(["F1"], name, name);

/** Waits for a frame with a text; views with pages are frames in frames. */
async function untilFrame(what, wanted, isRight) {
  for (let tries = 0; tries < 300; tries++) {
    for (const frame of page.frames()) {
      const text = await frame.evaluate(() => document.body?.innerText ?? "").catch(() => "");
      if (text.includes(wanted) && (await isRight(frame))) {
        console.log(`✓ ${what}`);
        return frame;
      }
    }
    await new Promise(resolve => setTimeout(resolve, 300));
  }
  await picture("stuck");
  throw new Error(`waited for ${what}`);
}

try {
  await page.goto(`${url}/?folder=${workspace}`, { waitUntil: "domcontentloaded" });
  await page.waitForSelector(".monaco-workbench .explorer-folders-view .monaco-list-row", { timeout: 90_000 });

  await open("broken.nb");
  await until("the error is underlined", () => document.querySelector(".squiggly-error") !== null);
  await until("words are highlighted", () => {
    const words = [...document.querySelectorAll(".view-line span span")];
    return new Set(words.map(word => getComputedStyle(word).color)).size > 2;
  });
  await picture("diagnostics");

  await open("good.nb");
  // Lenses are drawn again when the figures of the circuit are known.
  await until("the lens with figures is there", shows, ".codelens-decoration a", "1 robot");
  await picture("lenses");
  const place = await page.evaluate(() => {
    const lenses = [...document.querySelectorAll(".codelens-decoration a")];
    const { x, y } = lenses.find(lens => lens.textContent === "run in physics").getBoundingClientRect();
    return { x, y };
  });
  await page.mouse.click(place.x + 5, place.y + 5);
  const report = await untilFrame("the report is shown", "1 of 1 test passed", () => true);
  const played = frame => frame.evaluate(() => document.querySelector(".clock")?.textContent ?? "");
  const before = await played(report);
  await report.evaluate(() => document.querySelector(".play").click());
  await untilFrame("the film of the report plays", "made by nbc", async frame => (await played(frame)) !== before);
  await picture("report");

  await open("failing.nb");
  await command("Test: Run All Tests");
  await until("the failed row is marked", () => document.querySelector(".codicon-testing-failed-icon") !== null);
  await command("Testing: Focus on Test Explorer View");
  await page.waitForSelector(".test-explorer .monaco-list-row", { timeout: 90_000 });
  await page.click(".test-explorer .monaco-list-row");
  for (let step = 0; step < 3; step++) await page.keyboard.press("ArrowRight");
  await until("the explorer has the row", shows, ".test-explorer .monaco-list-row", "1 1 | 1");
  const rows = await page.$$eval(".test-explorer .monaco-list-row", rows => rows.map(row => row.ariaLabel));
  console.log(rows);
  const state = text => rows.find(row => row?.includes(text)) ?? "";
  assert.match(state("1 1 | 1"), /Failed/);
  assert.match(state("0 0 | 1"), /Passed/);
  await picture("tests");

  await open("good.nb");
  await until("the hint is there", shows, ".view-line", "inverter: 1 robot");
  configure(path.join(workspace, ".vscode"), { "nbc.codeLenses": false, "nbc.inlayHints.robots": false });
  await until("the settings remove lenses", () => document.querySelector(".codelens-decoration a") === null);
  await until("the settings remove hints", () => !document.querySelector(".view-lines").textContent.includes("robot"));

  configure(path.join(workspace, ".vscode"), { "nbc.path": "/no/nbc" });
  await until("without nbc, help is offered", shows, ".notifications-toasts", "How to Install");
  assert.equal(await page.$(".notifications-toasts .codicon-error"), null, "nothing failed");
  await picture("missing");
  const button = await page.evaluate(() => {
    const buttons = [...document.querySelectorAll(".notifications-toasts .monaco-button")];
    const { x, y } = buttons.find(button => button.textContent.includes("How to Install")).getBoundingClientRect();
    return { x, y };
  });
  await page.mouse.click(button.x + 5, button.y + 5);
  await untilFrame("the help is shown", "cargo install", () => true);
  configure(path.join(workspace, ".vscode"), {});
  await open("broken.nb");
  await until("with nbc again, the error is back", () => document.querySelector(".squiggly-error") !== null);
} finally {
  await browser.close();
  server.kill();
  rmSync(home, { recursive: true, force: true });
}
console.log(`pictures are in ${pictures}`);
