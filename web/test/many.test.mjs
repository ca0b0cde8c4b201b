// Two hundred robots: only those in view are sent and drawn, and the page stays fluid.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { closeBrowser, cyclesLater, typeNumber, visit, walking } from "./browser.mjs";
import { folderWith, needs, play } from "./program.mjs";

// A chain of full adders of two-input gates.
const ADDER = `circuit wide(a[25], b[25], cin) -> (sum[25], cout) {
    net c[26]
    c[0] = cin
    for i in 0..25 {
        (sum[i], c[i + 1]) = one_bit(a[i], b[i], c[i])
    }
    cout = c[25]
}

circuit one_bit(a, b, c) -> (sum, carry) {
    n1 = nand(a, b)
    n2 = nand(a, n1)
    n3 = nand(b, n1)
    t  = nand(n2, n3)
    n4 = nand(t, c)
    n5 = nand(t, n4)
    n6 = nand(c, n4)
    sum   = nand(n5, n6)
    carry = nand(n1, n4)
}

library nands { from: shipped, behaviors: [nand] }

swarm wide_nands { circuit: wide, library: nands }

test wide {
    a b cin | sum cout
    25'd1 25'd2 0 | 25'd3 0
}
`;

let place, program, page;

before(async () => {
  place = folderWith({ "wide.nb": ADDER });
  program = await play(place.folder, "wide.nb");
  page = await visit(program.url);
  await page.locator(".circuit option").nth(1).waitFor({ state: "attached" });
});

after(async () => {
  await page?.leave();
  await closeBrowser();
  await program?.stop();
  place?.remove();
});

test("a swarm of two hundred walks", async () => {
  await page.locator(".circuit").selectOption({ label: "wide as wide_nands" });
  await page.waitForFunction(
    () => Number(/^(\d+) robots/.exec(document.querySelector(".swarm .status").textContent)?.[1]) >= 200,
  );
  await walking(page);
});

test("frames carry the poses of the lanes in view only", { skip: needs("web socket") }, async () => {
  // Frames that were made before the page said what is in view still have all robots.
  const size = await page.evaluate(
    () =>
      new Promise(resolve => {
        const original = Object.getOwnPropertyDescriptor(MessageEvent.prototype, "data");
        Object.defineProperty(MessageEvent.prototype, "data", {
          configurable: true,
          get() {
            const data = original.get.call(this);
            const robots = data instanceof ArrayBuffer ? new DataView(data).getUint16(30, true) : 0;
            if (robots > 0 && robots < 100) {
              resolve(robots);
            }
            return data;
          },
        });
      }),
  );
  assert.ok(size > 0);
});

test("scrolling brings the others", async () => {
  await page.locator(".stage").evaluate(stage => (stage.scrollTop = stage.scrollHeight));
  await cyclesLater(page, 2);
});

test("a box of the schematic opens, and its robots are shown alone", async () => {
  const high = () => page.locator(".stage").evaluate(stage => stage.scrollHeight);
  const before = await high();
  const boxes = await page.locator('.schematic [data-id^="part-"]').count();
  assert.ok(boxes > 0 && boxes <= 40, `${boxes} boxes`);
  await page.locator('.schematic [data-id^="part-"]').first().press("Enter");
  await page.waitForFunction(before => document.querySelector(".stage").scrollHeight < before / 2, before);
  assert.equal(await page.locator(".crumbs button").count(), 2);
  await page.locator(".crumbs button").first().press("Enter");
  await page.waitForFunction(before => document.querySelector(".stage").scrollHeight >= before, before);
});

test("all robots are seen at once, and one of them can be followed", async () => {
  await page.locator('[data-do="crowd"]').click();
  assert.equal(await page.locator('[data-do="crowd"]').getAttribute("aria-pressed"), "true");
  await page.waitForFunction(() => {
    const stage = document.querySelector(".stage");
    return stage.scrollHeight <= stage.clientHeight;
  });
  await cyclesLater(page, 2);
  const colors = await page.locator(".stage canvas").evaluate(canvas => {
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    return new Set(Array.from({ length: data.length / 4 }, (_, i) => data.slice(4 * i, 4 * i + 3).join())).size;
  });
  assert.ok(colors > 4, `${colors} colors`);
  await page.locator(".stage").click({ position: { x: 10, y: 10 } });
  await page.locator(".scene .facts").waitFor();
  await page.locator(".stage").press("Escape");
  await page.locator('[data-do="crowd"]').click();
  await page.waitForFunction(() => {
    const stage = document.querySelector(".stage");
    return stage.scrollHeight > stage.clientHeight;
  });
});

test("a number is added", async () => {
  await typeNumber(page.locator('input[data-input="a"]'), 1234567);
  await page.locator('input[data-input="a"]').press("Enter");
  await typeNumber(page.locator('input[data-input="b"]'), 7654321);
  await page.locator('input[data-input="b"]').press("Enter");
  await page.locator(".speed").selectOption("max");
  await page.waitForFunction(() => document.querySelector('[data-output="sum"]').textContent === "8888888");
});
