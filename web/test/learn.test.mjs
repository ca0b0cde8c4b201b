// Every lesson is done by doing it, in Chromium on a server several at once. Firefox gives what is typed to one page
// only, and a page without a program computes with all processors: there it is one after the other.

import assert from "node:assert/strict";
import { after, before, describe, test } from "node:test";

import { BROWSER, closeBrowser, visit } from "./browser.mjs";
import { SHIPPED, lessonsOf, playLesson } from "./lessons.mjs";
import { SITE, folderWith, play } from "./program.mjs";

const LESSONS = lessonsOf(SHIPPED);

let place, program;

before(async () => {
  place = folderWith({});
  program = await play(place.folder, undefined, {
    more: process.env.LESSONS ? ["--lessons", process.env.LESSONS] : [],
  });
});

after(async () => {
  await closeBrowser();
  await program?.stop();
  place?.remove();
});

describe("lessons", { concurrency: SITE === undefined && BROWSER === "chromium" ? 4 : 1 }, () => {
  for (const lesson of LESSONS) {
    test(lesson.name, async () => {
      const page = await visit(program.url);
      await page.locator(`[data-lesson="${lesson.name}"]`).waitFor({ state: "attached" });
      await page.locator(".speed").selectOption("16×");
      await playLesson(page, lesson);
      await page.locator("#tab-learn").click();
      await page.locator(`.lesson[data-lesson="${lesson.name}"][data-finished="true"]`).waitFor();
      assert.equal(await page.locator('.lesson[data-finished="true"]').count(), 1);
      await page.leave();
    });
  }
});
