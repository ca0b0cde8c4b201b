// Lessons in Firefox, where there is one: the first one, and one whose program is changed.

import assert from "node:assert/strict";
import { test } from "node:test";

import { FIREFOX, firefox } from "./bidi.mjs";
import { LATCH, folderWith, play } from "./program.mjs";

const skip = FIREFOX === undefined ? "no Firefox on this machine" : false;

test("lessons are done in Firefox", { skip }, async () => {
  const place = folderWith({ "latch.nb": LATCH });
  const program = await play(place.folder, "latch.nb", { more: ["--class"] });
  const page = await firefox(program.url);
  const there = selector => page.until(wanted => document.querySelector(wanted) !== null, selector);
  const opens = async name => {
    await page.until(file => document.querySelector(".file").textContent === file, `lesson_${name}.nb`);
    await page.until(() => document.querySelector(".swarm .status").dataset.state === "ready");
  };
  const done = count =>
    page.until(least => document.querySelectorAll('.strip .steps li[data-done="true"]').length >= least, count);
  try {
    await there("[data-lesson=gate]");
    await page.run(() => {
      const speed = document.querySelector(".speed");
      speed.value = "16×";
      speed.dispatchEvent(new Event("change"));
    });
    await page.click("#tab-learn");
    await page.click("[data-do=class-name]");
    await page.keys("Fox\uE007");
    await page.until(() => document.querySelector(".class h3").textContent === "You are in the class as Fox");
    await page.click("[data-lesson=gate] [data-do=begin]");
    await opens("gate");
    await page.click(".strip [data-do=hint]");
    assert.equal(await page.run(() => document.querySelectorAll(".strip .hints li").length), 1);
    await page.click('button[data-input="a"]');
    await done(1);
    await page.click('button[data-input="a"]');
    await done(2);
    await there('.strip[data-finished="true"]');
    await page.click("#tab-learn");
    await page.click("[data-lesson=and] [data-do=begin]");
    await opens("and");
    // The last line of the circuit, from `q = t` to `q = t nand t`.
    await page.run(() => document.querySelector(".edit .editor, .edit > div:nth-of-type(3)")?.scrollIntoView());
    await page.run(() => {
      const root = [...document.querySelectorAll("*")].find(element => element.shadowRoot !== null).shadowRoot;
      const line = [...root.querySelectorAll(".cm-line")].find(one => one.textContent.includes("q = t"));
      const range = document.createRange();
      range.selectNodeContents(line);
      range.collapse(false);
      root.querySelector(".cm-content").focus();
      getSelection().setBaseAndExtent(range.endContainer, range.endOffset, range.endContainer, range.endOffset);
    });
    await page.keys(" nand t");
    await page.click("#tab-tests");
    await page.click("[data-do=all-logic]");
    await there('.strip .score[data-stars="3"]');
    await page.click(".strip [data-do=again]");
    await there(".strip [data-do=bring-back]");
    assert.deepEqual(page.errors, []);
  } finally {
    await page.leave();
    await program.stop();
    place.remove();
  }
});
