// A class: learners join with a name, the teacher's page shows where they are, and they can leave.

import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";

import { setInput, typeProgram, visit, walking } from "./browser.mjs";
import { done } from "./lessons.mjs";
import { served } from "./opened.mjs";
import { LATCH, play } from "./program.mjs";

const here = served({ "latch.nb": LATCH }, "latch.nb", { more: ["--class"] });

async function learner(name) {
  const page = await visit(here.program.url);
  await walking(page);
  await page.locator("#tab-learn").click();
  await page.locator("[data-do=class-name]").pressSequentially(name);
  await page.keyboard.press("Enter");
  return page;
}

const row = (board, name) => board.locator("tbody tr").filter({ has: board.locator("th", { hasText: name }) });

test("the teacher sees who is at which step, and names are nothing but text", async () => {
  const board = await visit(here.program.teacher());
  await board.getByText("Nobody has joined yet.").waitFor();
  const evil = "<img src=x onerror=1>";
  const [ada, other] = [await learner("Ada"), await learner(evil)];
  await ada.getByText("You are in the class as Ada").waitFor();
  await row(board, "Ada").waitFor();
  await row(board, evil).waitFor();
  assert.equal(await board.locator("img").count(), 0);
  await ada.locator("[data-lesson=gate] [data-do=begin]").click();
  await row(board, "Ada").getByText("step 1 of 2").waitFor();
  await ada.locator(".speed").selectOption("16×");
  await setInput(ada, "a", 1);
  await done(ada, 1);
  await row(board, "Ada").getByText("step 2 of 2").waitFor();
  assert.match(await row(board, "Ada").textContent(), /A robot is a gate/);
  // A reload joins again by itself.
  await ada.reload();
  await row(board, "Ada").getByText("step 2 of 2").waitFor();
  await ada.locator("#tab-learn").click();
  await ada.getByText("You are in the class as Ada").waitFor();
  const twin = await learner("ADA");
  await twin.getByText("somebody else is called ADA").waitFor();
  await ada.locator("[data-do=leave-class]").click();
  await row(board, "Ada").waitFor({ state: "detached" });
  await ada.reload();
  await ada.locator("[data-do=join]").waitFor();
  await other.leave();
  await board.getByText("Nobody has joined yet.").waitFor();
  await ada.leave();
  await twin.leave();
  await board.leave();
});

test("learners save beside each other, never over each other", async () => {
  const [ada, ben] = [await learner("Ada"), await learner("Ben")];
  for (const [page, name] of [
    [ada, "Ada"],
    [ben, "Ben"],
  ]) {
    await page.getByText(`You are in the class as ${name}`).waitFor();
    await typeProgram(page, `${LATCH}\n// of ${name}\n`);
    await page.locator("[data-do=save]").click();
    await page.getByText("is not a file of yours: the class shares this folder").waitFor();
    await page.getByRole("button", { name: `Save as latch.${name}.nb` }).click();
    await page.locator('.file[data-unsaved="false"]').waitFor();
    assert.equal(await page.locator(".file").textContent(), `latch.${name}.nb`);
  }
  const onDisk = name => readFileSync(path.join(here.place.folder, name), "utf8");
  assert.deepEqual(readdirSync(here.place.folder).sort(), ["latch.Ada.nb", "latch.Ben.nb", "latch.nb"]);
  assert.equal(onDisk("latch.nb"), LATCH);
  assert.match(onDisk("latch.Ada.nb"), /of Ada/);
  await ada.leave();
  await ben.leave();
});

test("learners who use the same browser have drafts and progress of their own", async () => {
  const page = await learner("Eve");
  const shown = text => page.locator(".cm-content").getByText(text).waitFor();
  await page.getByText("You are in the class as Eve").waitFor();
  await typeProgram(page, `${LATCH}\n// of Eve\n`);
  await page.locator('.file[data-unsaved="true"]').waitFor();
  await page.locator("[data-do=leave-class]").click();
  await page.locator("[data-do=join]").waitFor();
  assert.equal(await page.locator('.file[data-unsaved="false"]').count(), 1, "nobody else sees her draft");
  await page.locator("[data-do=class-name]").fill("Mel");
  await page.locator("[data-do=join]").click();
  await page.getByText("You are in the class as Mel").waitFor();
  await typeProgram(page, `${LATCH}\n// of Mel\n`);
  await page.locator('.file[data-unsaved="true"]').waitFor();
  await page.locator("[data-do=leave-class]").click();
  await page.locator("[data-do=join]").waitFor();
  await page.locator("[data-do=class-name]").fill("Eve");
  await page.locator("[data-do=join]").click();
  await page.getByText("You are in the class as Eve").waitFor();
  await shown("// of Eve");
  await page.leave();
});

test("the addresses of learners and teacher open nothing of each other", async () => {
  const teacher = here.program.teacher();
  const status = async address => (await fetch(address)).status;
  assert.equal(await status(new URL("members", teacher)), 200);
  assert.equal(await status(new URL("members", here.program.url)), 404);
  for (const name of ["live", "language", "take/1/a", "app.js"]) {
    assert.equal(await status(new URL(name, teacher)), 404, name);
  }
  const post = await fetch(new URL("members", teacher), { method: "POST" });
  assert.equal(post.status, 405);
  const foreign = await fetch(new URL("members", teacher), { headers: { origin: "http://evil.example" } });
  assert.equal(foreign.status, 403);
});

test("without --class there is none", async () => {
  const alone = await play(here.place.folder, "latch.nb");
  assert.equal(alone.teacher(), undefined);
  const page = await visit(alone.url);
  await walking(page);
  await page.locator("#tab-learn").click();
  assert.equal(await page.locator(".class").isVisible(), false);
  await page.leave();
  await alone.stop();
});
