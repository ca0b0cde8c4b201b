// Nothing is lost: drafts in two tabs, in a browser that keeps nothing, and in the list of programs; files from a disk.

import assert from "node:assert/strict";
import { test } from "node:test";

import { typeProgram, visit, walking } from "./browser.mjs";
import { served } from "./opened.mjs";
import { LATCH, SITE } from "./program.mjs";

const gate = word => `circuit gate(a, b) -> (q) {\n    q = a ${word} b\n}\n`;
const here = served({ "gate.nb": gate("and"), "latch.nb": LATCH }, "gate.nb");
const EXAMPLE = "majority.nb";

const shows = (page, name) => page.waitForFunction(want => document.querySelector(".file").textContent === want, name);
const has = (page, text) => page.locator(".cm-content").getByText(text).first().waitFor();
const unsaved = (page, is = true) => page.locator(`.file[data-unsaved="${is}"]`).waitFor();
const list = page => page.locator("[data-do=open]").click();
const at = name => `${here.program.address}#${name}`;

async function opens(name, options = {}) {
  const page = await visit(at(name), options);
  await shows(page, name);
  return page;
}

test("two tabs at one address keep the changes of both", async () => {
  const first = await opens("gate.nb");
  const second = await first.context().newPage();
  await second.goto(at("gate.nb"));
  await shows(second, "gate.nb");
  await typeProgram(first, gate("nor"));
  await unsaved(first);
  await typeProgram(second, gate("xor"));
  await second.getByText("Another tab has unsaved changes of gate.nb. Yours are gate_2.nb from here on.").waitFor();
  await typeProgram(first, gate("xnor"));
  for (const [page, name, word] of [
    [first, "gate.nb", "xnor"],
    [second, "gate_2.nb", "xor"],
  ]) {
    await page.reload();
    await shows(page, name);
    await has(page, `q = a ${word} b`);
    await unsaved(page);
  }
  // Each is in the list of the other.
  await list(first);
  await first.locator('.files [data-open="gate_2.nb"]').click();
  await has(first, "q = a xor b");
  await first.leave();
});

/** In a document: a browser whose memory is full, or that forbids to have one. */
const FORBIDDING = {
  full: () => {
    Storage.prototype.setItem = () => {
      throw new DOMException("full", "QuotaExceededError");
    };
  },
  denied: () => {
    const get = () => {
      throw new DOMException("denied", "SecurityError");
    };
    Object.defineProperty(window, "localStorage", { get });
  },
};

const keepsNothing = how => async () => {
  const page = await opens("gate.nb");
  await page.evaluate(FORBIDDING[how]);
  await typeProgram(page, gate("nor"));
  await unsaved(page);
  for (const leave of [
    () => page.locator('.files [data-open="latch.nb"]').first().click(),
    () => page.locator("[data-do=new]").click(),
  ]) {
    await list(page);
    await leave();
    await page.getByText("gate.nb is not saved").waitFor();
    await page.locator("dialog.ask [data-do=stay]").click();
    await has(page, "q = a nor b");
  }
  await page.locator("#tab-learn").click();
  await page.locator("[data-lesson=gate] [data-do=begin]").click();
  await page.locator("dialog.ask [data-do=stay]").click();
  await has(page, "q = a nor b");
  // The browser asks before the page is closed.
  const asked = new Promise(resolve =>
    page.once("dialog", dialog => dialog.dismiss().then(() => resolve(dialog.type()), resolve)),
  );
  await page.close({ runBeforeUnload: true });
  assert.equal(await asked, "beforeunload");
  await list(page);
  await page.locator('.files [data-open="latch.nb"]').first().click();
  await page.locator("dialog.ask [data-do=leave]").click();
  await shows(page, "latch.nb");
  await page.leave();
};

for (const how of Object.keys(FORBIDDING)) {
  test(`a program that a browser cannot keep is not left without a question: ${how}`, keepsNothing(how));
}

test("an edited example has its dot after a reload, and is in the list", async () => {
  const page = await opens(EXAMPLE);
  await unsaved(page, false);
  await typeProgram(page, gate("nor"));
  await unsaved(page);
  await page.reload();
  await shows(page, EXAMPLE);
  await has(page, "q = a nor b");
  await unsaved(page);
  await list(page);
  const entry = page.locator(".files section:not(:last-child) li", { has: page.locator(`[data-open="${EXAMPLE}"]`) });
  await entry.locator(".unsaved").waitFor();
  await page.keyboard.press("Escape");
  // What is as it was before is no change.
  await page.getByRole("button", { name: "Discard them" }).click();
  await unsaved(page, false);
  await page.leave();
});

test("a draft can be deleted, brought back, renamed and opened from the list", async () => {
  const page = await opens("gate.nb");
  await list(page);
  await page.getByLabel("Name of the new file").fill("mine");
  await page.locator("[data-do=new]").click();
  await shows(page, "mine.nb");
  await typeProgram(page, gate("nor"));
  await unsaved(page);
  await list(page);
  await page.locator('.files [data-open="gate.nb"]').click();
  await shows(page, "gate.nb");
  await list(page);
  await page.locator('[data-delete="mine.nb"]').click();
  await page.locator('.files [data-open="mine.nb"]').waitFor({ state: "detached" });
  await page.getByText("mine.nb was deleted.").waitFor();
  await page.locator("[data-do=undo-delete]").click();
  await page.locator('[data-rename="mine.nb"]').click();
  await page.locator("dialog.ask input").fill("yours.nb");
  await page.keyboard.press("Enter");
  await page.locator('.files [data-open="yours.nb"]').click();
  await has(page, "q = a nor b");
  await unsaved(page);
  await page.reload();
  await shows(page, "yours.nb");
  await has(page, "q = a nor b");
  assert.equal(await page.locator(".cm-content").getByText("nor").count(), 1);
  await page.leave();
});

test("a file of the browser can be renamed and deleted, in all tabs", { skip: SITE === undefined }, async () => {
  const page = await opens("latch.nb");
  await list(page);
  await page.locator('[data-rename="gate.nb"]').click();
  await page.locator("dialog.ask input").fill("door.nb");
  await page.keyboard.press("Enter");
  await page.locator('.files [data-open="door.nb"]').waitFor();
  await page.locator('.files [data-open="gate.nb"]').waitFor({ state: "detached" });
  await page.locator('[data-delete="latch.nb"]').first().click();
  await page.keyboard.press("Escape");
  await page.getByText("latch.nb was deleted. Save to write it again.").waitFor();
  await page.reload();
  await walking(page);
  await list(page);
  await page.locator('.files [data-open="door.nb"]').waitFor();
  assert.equal(await page.locator('.files [data-delete="gate.nb"]').count(), 0);
  await page.leave();
});

test("a shared program with the name of an example does not come back as one's own changes", async () => {
  const permissions = ["clipboard-read", "clipboard-write"];
  const page = await opens(EXAMPLE, { permissions });
  await typeProgram(page, gate("nor"));
  await page.locator(".take summary").click();
  await page.locator('[data-take="any-link"]').click();
  await page.locator(".links .status", { hasText: "copied" }).waitFor();
  const link = await page.evaluate(() => navigator.clipboard.readText());
  await page.leave();
  const other = await visit(`${here.program.address}${link}`);
  await other.locator("[data-notice=shared]").waitFor();
  await shows(other, EXAMPLE.replace(".nb", "_2.nb"));
  await list(other);
  await other.locator(`.files [data-open="${EXAMPLE}"]`).click();
  await shows(other, EXAMPLE);
  await has(other, "circuit majority");
  await unsaved(other, false);
  assert.equal(await other.locator("[data-notice=draft]").count(), 0);
  await other.leave();
});

/** Drops files on an element, as from a disk. */
const drop = (page, files, on = ".edit") =>
  page.evaluate(
    ([all, selector]) => {
      const dataTransfer = new DataTransfer();
      all.forEach(([name, text]) => dataTransfer.items.add(new File([text], name)));
      const target = document.querySelector(selector);
      for (const type of ["dragover", "drop"]) {
        target.dispatchEvent(new DragEvent(type, { dataTransfer, bubbles: true, cancelable: true, composed: true }));
      }
    },
    [files, on],
  );

test("a program from a disk is opened, and not inserted into the present one", async () => {
  const page = await opens("gate.nb");
  await drop(page, [["dropped.nb", gate("nor")]], ".editor");
  await shows(page, "dropped.nb");
  await has(page, "q = a nor b");
  await list(page);
  await page.locator('.files [data-open="gate.nb"]').click();
  await has(page, "q = a and b");
  await list(page);
  const chosen = { name: "chosen.nb", mimeType: "text/plain", buffer: Buffer.from(gate("xor")) };
  await page.locator("[data-do=import]").setInputFiles([chosen]);
  await shows(page, "chosen.nb");
  await has(page, "q = a xor b");
  await drop(page, [["un\u200bseen.nb", gate("or")]]);
  await page.getByText("its name has invisible characters").waitFor();
  await page.keyboard.press("Escape");
  // A file of another kind is where programs find it, or the page says where to put it.
  await drop(page, [
    ["rows.csv", "a,b,q\n0,0,1\n"],
    ["picture.png", "\u0000"],
    ["and.v", "module both(input a, b, output q);\n  assign q = a & b;\nendmodule\n"],
  ]);
  await page.getByText(SITE === undefined ? "Put other files into the folder" : "3 files imported.").waitFor();
  await page.leave();
});
