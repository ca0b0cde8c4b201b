// Editing: a mistake and its fix, saving, drafts, and files that others change.

import assert from "node:assert/strict";
import { test } from "node:test";

import { filesOf, typeProgram, walking } from "./browser.mjs";
import { opened } from "./opened.mjs";
import { LATCH, needs } from "./program.mjs";

const GATE = "circuit gate(a, b) -> (q) {\n    q = a and b\n}\n";

const VERILOG = `module toggle(input clk, input t, output reg q);
  always @(posedge clk) if (t) q <= ~q;
endmodule
module both(input [1:0] a, output q);
  assign q = &a;
endmodule
`;

const here = opened({ "latch.nb": LATCH, "gate.nb": GATE, "both.nb": GATE, "both.v": VERILOG }, "gate.nb");

const files = filesOf(here);

test("a mistake is shown at its place, and the swarm follows its fix", async () => {
  await typeProgram(here.page, GATE.replace("a and b", "a and c"));
  await here.page.locator(".cm-lintRange-error").waitFor();
  await here.page.locator('.swarm .status[data-state="errors"]').waitFor();
  // The list below the editor says it without a pointer, and leads there.
  const listed = here.page.locator('.problems [data-severity="error"] button');
  assert.match(await listed.textContent(), /^line 2: no net is called `c`/);
  await listed.click();
  await here.page.waitForFunction(() =>
    document.querySelector(".editor").shadowRoot.querySelector(".cm-activeLine").textContent.includes("a and c"),
  );
  await typeProgram(here.page, GATE.replace("a and b", "a nor b"));
  await here.page.locator(".cm-lintRange-error").waitFor({ state: "detached" });
  await here.page.locator(".problems").waitFor({ state: "hidden" });
  await here.page.waitForFunction(() => /^1 robot/.test(document.querySelector(".swarm .status").textContent));
  await here.page.waitForFunction(() =>
    document.querySelector('.schematic [data-id="cell-0"]')?.textContent.includes("q = nor(a, b)"),
  );
});

test("a line after an open brace is further in", async () => {
  await here.page.locator(".cm-content").click();
  await here.page.keyboard.press("Control+End");
  await here.page.keyboard.type("\ncircuit more(a) -> (b) {\nb = a");
  const lines = await here.page.locator(".cm-line").allTextContents();
  assert.deepEqual(lines.slice(-3), ["circuit more(a) -> (b) {", "    b = a", "}"]);
  await typeProgram(here.page, GATE.replace("a and b", "a nor b"));
});

test("nothing is written until it is saved", async () => {
  assert.equal(await files.read("gate.nb"), GATE);
  await here.page.locator('.file[data-unsaved="true"]').waitFor();
  await here.page.locator(".cm-content").press("Control+s");
  await here.page.locator('.file[data-unsaved="false"]').waitFor();
  await files.has("gate.nb", /a nor b/);
});

test("a draft survives a reload and can be discarded", async () => {
  await typeProgram(here.page, GATE.replace("a and b", "a xor b"));
  await here.page.locator('.file[data-unsaved="true"]').waitFor();
  await here.page.reload();
  await here.page.locator("[data-notice=draft]").waitFor();
  assert.match(await here.page.locator(".cm-content").textContent(), /a xor b/);
  await here.page.getByRole("button", { name: "Discard them" }).click();
  await here.page.locator('.file[data-unsaved="false"]').waitFor();
  assert.match(await here.page.locator(".cm-content").textContent(), /a nor b/);
});

test("a file that another program changed is noticed", async () => {
  await files.write("gate.nb", GATE.replace("a and b", "a or b"));
  await here.page.locator("[data-notice=changed]").waitFor();
  await here.page.getByRole("button", { name: "Load theirs" }).click();
  await here.page.waitForFunction(() => document.querySelector(".editor").shadowRoot.textContent.includes("a or b"));
  await here.page.locator('.file[data-unsaved="false"]').waitFor();
});

test("one's own text can be kept, and is then saved over the other", async () => {
  await typeProgram(here.page, GATE.replace("a and b", "a xnor b"));
  await files.write("gate.nb", GATE);
  await here.page.locator("[data-notice=changed]").waitFor();
  await here.page.getByRole("button", { name: "Keep mine" }).click();
  await here.page.locator("[data-notice=changed]").waitFor({ state: "detached" });
  await here.page.locator("[data-do=save]").click();
  await here.page.locator('.file[data-unsaved="false"]').waitFor();
  await files.has("gate.nb", /a xnor b/);
});

test("a draft of an older file is not saved over a newer one without a question", async () => {
  await typeProgram(here.page, GATE.replace("a and b", "not a"));
  await here.page.locator('.file[data-unsaved="true"]').waitFor();
  const address = here.page.url();
  await here.page.goto("about:blank");
  const theirs = GATE.replace("a and b", "not b");
  await files.write("gate.nb", theirs);
  await here.page.goto(address);
  const notice = here.page.locator("[data-notice=changed]");
  await notice.getByText("The file was changed since then").waitFor();
  assert.match(await here.page.locator(".cm-content").textContent(), /q = not a/);
  await here.page.locator("[data-do=save]").click();
  await notice.getByText("was changed by another program since you opened it").waitFor();
  assert.equal(await files.read("gate.nb"), theirs);
  await notice.getByRole("button", { name: "Load theirs" }).click();
  await here.page.locator('.file[data-unsaved="false"]').waitFor();
  await typeProgram(here.page, GATE);
  await here.page.locator("[data-do=save]").click();
  await here.page.locator('.file[data-unsaved="false"]').waitFor();
  await files.has("gate.nb", /q = a and b/);
});

test("the language server explains, formats and renames", async () => {
  await typeProgram(here.page, "circuit gate(first, b) -> (q) {\n  q = first   and b\n}\n");
  await here.page.locator(".cm-content").getByText("gate").hover();
  await here.page.locator(".cm-tooltip-hover").waitFor();
  await here.page.keyboard.press("Shift+Alt+F");
  await here.page.waitForFunction(() =>
    document.querySelector(".editor").shadowRoot.textContent.includes("    q = first and b"),
  );
  await here.page.keyboard.press("Control+Home");
  for (let column = 0; column < "circuit gate(fi".length; column++) {
    await here.page.keyboard.press("ArrowRight");
  }
  await here.page.keyboard.press("F2");
  await here.page.locator(".cm-lsp-rename-panel input").fill("second");
  await here.page.keyboard.press("Enter");
  await here.page.waitForFunction(() =>
    document.querySelector(".editor").shadowRoot.textContent.includes("q = second and b"),
  );
});

test("words are completed, and a name leads to its definition", async () => {
  await typeProgram(here.page, "circuit gate(first, b) -> (q) {\n    q = not b\n}\n");
  await here.page.keyboard.press("Control+Home");
  await here.page.keyboard.press("ArrowDown");
  await here.page.keyboard.press("End");
  await here.page.keyboard.type(" and fir");
  await here.page.locator(".cm-tooltip-autocomplete").getByText("first").first().waitFor();
  await here.page.locator(".cm-tooltip-autocomplete").getByText("first").first().click();
  await here.page.waitForFunction(() =>
    document.querySelector(".editor").shadowRoot.textContent.includes("q = not b and first"),
  );
  await here.page.keyboard.press("F12");
  await here.page.waitForFunction(() =>
    document.querySelector(".editor").shadowRoot.querySelector(".cm-activeLine").textContent.startsWith("circuit"),
  );
});

test("a quick fix is offered beside the line and at the cursor", async () => {
  const wrong = "circuit gate(first, b) -> (q) {\n    q = frist and b\n}\n";
  const mended = () =>
    here.page.waitForFunction(() =>
      document.querySelector(".editor").shadowRoot.textContent.includes("q = first and b"),
    );
  await typeProgram(here.page, wrong);
  await here.page.locator(".cm-fix-sign").click();
  await here.page.locator(".cm-fix-list button").first().click();
  await mended();
  await typeProgram(here.page, wrong);
  await here.page.locator(".cm-fix-sign").waitFor();
  await here.page.keyboard.press("Control+Home");
  await here.page.keyboard.press("ArrowDown");
  await here.page.keyboard.press("Control+.");
  await here.page.locator(".cm-fix-list button:focus").waitFor();
  await here.page.keyboard.press("Enter");
  await mended();
});

test("the keyboard leaves the editor, and the page says how", async () => {
  await here.page.locator(".problems").waitFor({ state: "hidden" });
  await here.page.locator(".cm-content").click();
  await here.page.getByText("Esc, then Tab leaves the editor").waitFor();
  await here.page.keyboard.press("Escape");
  await here.page.keyboard.press("Tab");
  assert.equal(await here.page.evaluate(() => document.activeElement.className), "divider");
});

test("other files, examples and new files can be opened", async () => {
  await here.page.locator("[data-do=open]").click();
  await here.page
    .locator(".files section", { hasText: /In this folder|My programs/ })
    .locator('[data-open="latch.nb"]')
    .click();
  await here.page.waitForFunction(() => document.querySelector(".file").textContent === "latch.nb");
  await walking(here.page);
  await here.page.locator("[data-do=open]").click();
  await here.page.getByLabel("Name of the new file").fill("mine");
  await here.page.locator("[data-do=new]").click();
  await here.page.waitForFunction(() => document.querySelector(".file").textContent === "mine.nb");
  await here.page.locator("[data-do=save]").click();
  await here.page.locator("[data-do=save-as]").click();
  await here.page.locator('.file[data-unsaved="false"]').waitFor();
  await here.page.waitForFunction(() => document.querySelector("[data-do=save]").disabled);
  await files.has("mine.nb", /circuit mine/);
});

test("a new program stays where it is after a reload, and Back leads to the one before", async () => {
  const shows = name => here.page.waitForFunction(file => document.querySelector(".file").textContent === file, name);
  const open = async name => {
    await here.page.locator("[data-do=open]").click();
    await here.page.locator(`[data-open="${name}"]`).first().click();
    await shows(name);
  };
  await open("gate.nb");
  await here.page.locator("[data-do=open]").click();
  await here.page.getByLabel("Name of the new file").fill("untouched");
  await here.page.locator("[data-do=new]").click();
  await shows("untouched.nb");
  await here.page.reload();
  await shows("untouched.nb");
  assert.match(await here.page.locator(".cm-content").textContent(), /circuit mine/);
  await open("latch.nb");
  await here.page.goBack();
  await shows("untouched.nb");
  await here.page.goBack();
  await shows("gate.nb");
  await here.page.goForward();
  await shows("untouched.nb");
});

test("a name that is taken is not replaced without a question", async () => {
  await here.page.locator("[data-do=save]").click();
  await here.page.getByLabel("Path within the folder").fill("latch.nb");
  await here.page.locator("[data-do=save-as]").click();
  const notice = here.page.locator("[data-notice=changed]");
  await notice.getByText("latch.nb is there already").waitFor();
  assert.equal(await files.read("latch.nb"), LATCH);
  await notice.getByRole("button", { name: "Replace it" }).click();
  await here.page.waitForFunction(() => document.querySelector(".file").textContent === "latch.nb");
  await files.has("latch.nb", /circuit mine/);
});

test("Verilog is opened as a program with its modules as robots", { skip: needs("Yosys") }, async () => {
  await here.page.locator("[data-do=open]").click();
  await here.page.locator('[data-open="both.v"]').click();
  // The program of that name is another one.
  await here.page.waitForFunction(() => document.querySelector(".file").textContent === "both_2.nb");
  const text = await here.page.locator(".cm-content").textContent();
  assert.match(text, /use "both.v"/);
  assert.match(text, /swarm toggle_robots/);
  for (const circuit of ["toggle", "both"]) {
    const option = here.page.locator(".swarm .circuit option", { hasText: circuit });
    await option.first().waitFor({ state: "attached" });
  }
  await walking(here.page);
});
