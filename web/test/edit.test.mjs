// Editing: a mistake and its fix, saving, drafts, and files that others change.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { after, before, test } from "node:test";

import { closeBrowser, typeProgram, visit, walking } from "./browser.mjs";
import { LATCH, folderWith, play } from "./program.mjs";

const GATE = "circuit gate(a, b) -> (q) {\n    q = a and b\n}\n";

let place, program, page;

before(async () => {
  place = folderWith({ "latch.nb": LATCH, "gate.nb": GATE });
  program = await play(place.folder, "gate.nb");
  page = await visit(program.url);
  await walking(page);
});

after(async () => {
  await page?.leave();
  await closeBrowser();
  await program?.stop();
  place?.remove();
});

const onDisk = name => readFileSync(path.join(place.folder, name), "utf8");

test("a mistake is shown at its place, and the swarm follows its fix", async () => {
  await typeProgram(page, GATE.replace("a and b", "a and c"));
  await page.locator(".cm-lintRange-error").waitFor();
  await page.locator('.swarm .status[data-state="errors"]').waitFor();
  await typeProgram(page, GATE.replace("a and b", "a nor b"));
  await page.locator(".cm-lintRange-error").waitFor({ state: "detached" });
  await page.waitForFunction(() => /^1 robot/.test(document.querySelector(".swarm .status").textContent));
  await page.waitForFunction(() =>
    document.querySelector('.schematic [data-id="cell-0"]')?.textContent.includes("NOR"),
  );
});

test("nothing is written until it is saved", async () => {
  assert.equal(onDisk("gate.nb"), GATE);
  await page.locator('.file[data-unsaved="true"]').waitFor();
  await page.locator(".cm-content").press("Control+s");
  await page.locator('.file[data-unsaved="false"]').waitFor();
  assert.match(onDisk("gate.nb"), /a nor b/);
});

test("a draft survives a reload and can be discarded", async () => {
  await typeProgram(page, GATE.replace("a and b", "a xor b"));
  await page.locator('.file[data-unsaved="true"]').waitFor();
  await page.reload();
  await page.locator("[data-notice=draft]").waitFor();
  assert.match(await page.locator(".cm-content").textContent(), /a xor b/);
  await page.getByRole("button", { name: "Discard them" }).click();
  await page.locator('.file[data-unsaved="false"]').waitFor();
  assert.match(await page.locator(".cm-content").textContent(), /a nor b/);
});

test("a file that another program changed is noticed", async () => {
  writeFileSync(path.join(place.folder, "gate.nb"), GATE.replace("a and b", "a or b"));
  await page.locator("[data-notice=changed]").waitFor();
  await page.getByRole("button", { name: "Load theirs" }).click();
  await page.waitForFunction(() => document.querySelector(".editor").shadowRoot.textContent.includes("a or b"));
  await page.locator('.file[data-unsaved="false"]').waitFor();
});

test("one's own text can be kept, and is then saved over the other", async () => {
  await typeProgram(page, GATE.replace("a and b", "a xnor b"));
  writeFileSync(path.join(place.folder, "gate.nb"), GATE);
  await page.locator("[data-notice=changed]").waitFor();
  await page.getByRole("button", { name: "Keep mine" }).click();
  await page.locator("[data-notice=changed]").waitFor({ state: "detached" });
  await page.locator("[data-do=save]").click();
  await page.locator('.file[data-unsaved="false"]').waitFor();
  assert.match(onDisk("gate.nb"), /a xnor b/);
});

test("the language server explains, completes, formats and renames", async () => {
  await typeProgram(page, "circuit gate(first, b) -> (q) {\n  q = first   and b\n}\n");
  await page.locator(".cm-content").getByText("gate").hover();
  await page.locator(".cm-tooltip-hover").waitFor();
  await page.keyboard.press("Shift+Alt+F");
  await page.waitForFunction(() =>
    document.querySelector(".editor").shadowRoot.textContent.includes("    q = first and b"),
  );
  await page.keyboard.press("Control+Home");
  for (let column = 0; column < "circuit gate(fi".length; column++) {
    await page.keyboard.press("ArrowRight");
  }
  await page.keyboard.press("F2");
  await page.locator(".cm-lsp-rename-panel input").fill("second");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() =>
    document.querySelector(".editor").shadowRoot.textContent.includes("q = second and b"),
  );
});

test("other files, examples and new files can be opened", async () => {
  await page.locator("[data-do=open]").click();
  await page.locator(".files section", { hasText: "In this folder" }).locator('[data-open="latch.nb"]').click();
  await page.waitForFunction(() => document.querySelector(".file").textContent === "latch.nb");
  await walking(page);
  await page.locator("[data-do=open]").click();
  await page.locator(".files input").fill("mine");
  await page.locator("[data-do=new]").click();
  await page.waitForFunction(() => document.querySelector(".file").textContent === "mine.nb");
  await page.locator("[data-do=save]").click();
  await page.locator("[data-do=save-as]").click();
  await page.locator('.file[data-unsaved="false"]').waitFor();
  await page.waitForFunction(() => document.querySelector("[data-do=save]").disabled);
  assert.match(onDisk("mine.nb"), /circuit mine/);
});
