// A test that gives the inputs of the swarm while one watches, and the other side of its ports.

import assert from "node:assert/strict";
import { test } from "node:test";

import { setInput } from "./browser.mjs";
import { opened } from "./opened.mjs";

const TWO = `//! Reads one word after the other.

file program = "two.csv"

circuit two(char[2], clk) -> (at, q) {
    at = register(not at, clk)
    q  = char[0] and char[1]
}

environment desk(at) -> (char[2], screen: text) {
    net words[2][8] init program
    word   = words[at]
    char   = word[1..0]
    screen = {1, word}
}

test two "reads words" with desk {
    clk | q
    ^   | -
    ^   | -
    ^   | -
}
`;

const here = opened({ "two.nb": TWO, "two.csv": "72, 107\n" }, "two.nb", async page => {
  await page.locator(".speed").selectOption("max");
  await page.locator("#tab-tests").click();
  await page.locator(".test .count", { hasText: /^3 rows$/ }).waitFor();
  await page.locator(".test [data-do=watch]").click();
  await page.locator("#tab-swarm[aria-selected=true]").waitFor();
});

test("the screen and the words that are read are those of the cycle", async () => {
  const { page } = here;
  await page.locator(".inputs .caption", { hasText: "Inputs, from the test" }).waitFor();
  const memory = page.locator('.state [data-memory="words"]');
  assert.deepEqual(await memory.locator("th").allTextContents(), ["0", "1"]);
  assert.deepEqual(await memory.locator("td").allTextContents(), ["72", "107"]);
  await page.waitForFunction(() => document.querySelector("[data-screen]").textContent === "HkH");
  // The inputs are no longer given, and stay.
  await page.locator(".inputs .caption", { hasText: /^Inputs$/ }).waitFor();
  await memory.locator('tr[data-word="1"][aria-current=true]').waitFor();
  await memory.locator("caption", { hasText: "words, reads 1: 107" }).waitFor();
  await page.locator("[data-do=play][data-running=true]").click();
  await page.locator(".rewind").fill("1");
  await page.waitForFunction(() => document.querySelector("[data-screen]").textContent === "");
  await memory.locator('tr[data-word="0"][aria-current=true]').waitFor();
});

test("who flips a switch takes over", async () => {
  const { page } = here;
  await setInput(page, "clk", 1);
  await page.locator(".state [data-screen]").waitFor({ state: "detached" });
  await page.locator("[data-do=play]").click();
  await page.waitForFunction(() => /cycle ([4-9]|\d\d)/.test(document.querySelector(".cycle").textContent));
  assert.equal(await page.locator('button[data-input="clk"]').getAttribute("aria-checked"), "true");
});
