// What surrounds the lessons: hints, beginning again, programs that are kept, the score, and lessons of an author.

import assert from "node:assert/strict";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";

import { cyclesLater, setInput, typeProgram, visit, walking } from "./browser.mjs";
import { compiled, done, lessonsOf, playLesson, SHIPPED } from "./lessons.mjs";
import { opened } from "./opened.mjs";
import { LATCH, folderWith, needs, play } from "./program.mjs";

const here = opened({ "latch.nb": LATCH }, "latch.nb", async page => {
  await page.locator(".speed").selectOption("16×");
});

async function begin(name) {
  await here.page.locator("#tab-learn").click();
  await here.page.locator(`[data-lesson="${name}"] [data-do=begin]`).click();
  await here.page.waitForFunction(file => document.querySelector(".file").textContent === file, `lesson_${name}.nb`);
  await compiled(here.page);
}

test("hints are shown one after the other, and are those of the step", async () => {
  await begin("stimuli");
  const hint = here.page.locator(".strip [data-do=hint]");
  for (const [shown, label] of [
    [0, "Hint (1 of 3)"],
    [1, "Another hint (2 of 3)"],
    [2, "Another hint (3 of 3)"],
  ]) {
    assert.equal(await here.page.locator(".strip .hints li").count(), shown);
    assert.equal(await hint.textContent(), label);
    await hint.click();
  }
  assert.equal(await here.page.locator(".strip .hints li").count(), 3);
  assert.equal(await hint.count(), 0);
  await setInput(here.page, "a", 1);
  await setInput(here.page, "b", 1);
  await done(here.page, 1);
  assert.equal(await here.page.locator(".strip .hints").count(), 0);
  assert.equal(await hint.textContent(), "Hint (1 of 3)");
});

test("a reload in a lesson that nobody has touched shows its program", async () => {
  await begin("and");
  await here.page.reload();
  await here.page.waitForFunction(() => document.querySelector(".file").textContent === "lesson_and.nb");
  assert.equal(await here.page.locator('.file[data-unsaved="true"]').count(), 0);
});

const shipped = name => lessonsOf(SHIPPED).find(lesson => lesson.name === name);
const isDone = (page, step) => page.locator(`.strip .steps li:nth-child(${step})[data-done="true"]`).count();

test("a comment is no change of a program", async () => {
  for (const [name, step] of [
    ["counter", 2],
    ["machine", 2],
    ["computer", 2],
    ["own", 1],
  ]) {
    const page = await visit(`${here.program.address}#lesson/${name}/${step}`);
    await compiled(page);
    await page.locator(".strip .missing li").first().waitFor({ state: "detached" });
    await typeProgram(page, `${shipped(name).program}// x\n`);
    await compiled(page);
    await page.locator("#tab-tests").click();
    await page.locator("[data-do=all-logic]").click();
    await page.locator(".strip .missing").getByText("it is still that of the lesson").waitFor();
    assert.equal(await isDone(page, step), 0, name);
    await page.leave();
  }
});

test("calls of standard circuits are no gates, and a refusal quotes the word", async () => {
  const circuits = {
    xor: {
      "q = parity({a, b})": "calls of standard circuits are there",
      "q = select(2'b10, a) and not b or b and not a": "`not`, `and`, `or`, calls of standard circuits are there",
    },
    "full-adder": {
      "sum = parity({a, b, cin})\n    cout = select({a or b, a and b}, cin)": "calls of standard circuits are there",
    },
  };
  for (const [name, texts] of Object.entries(circuits)) {
    for (const [lines, expected] of Object.entries(texts)) {
      const { program } = shipped(name);
      await begin(name);
      await typeProgram(here.page, program.replace(/(circuit [^{]*\{\n)[^}]*}/, `$1    ${lines}\n}`));
      await compiled(here.page);
      await here.page.locator("#tab-tests").click();
      await here.page.locator("[data-do=all-logic]").click();
      await here.page.getByText("✓ passes as logic").waitFor();
      await here.page.locator(".strip .missing").getByText(expected).waitFor();
      assert.equal(await isDone(here.page, 1), 0);
      assert.equal(await here.page.locator(".strip .score").count(), 0);
    }
  }
  // An error of the program comes first.
  await typeProgram(here.page, "circuit full_adder(a, b, cin) -> (sum, cout) {\n    sum = c\n}\n");
  await here.page.locator(".strip .missing li").first().getByText("first, the error in the program: ").waitFor();
  await here.page.locator("#tab-learn").click();
});

test("a counter that still shows 3 does not pass by another test", async () => {
  const lesson = lessonsOf(SHIPPED).find(({ name }) => name === "counter");
  const page = await visit(`${here.program.address}#lesson/counter/2`);
  await compiled(page);
  const run = async text => {
    await typeProgram(page, text);
    await page.locator("#tab-tests").click();
    await page.locator("[data-do=all-logic]").click();
    await page.getByText("✓ passes as logic").waitFor();
  };
  await run(lesson.program.replace("counts to three", "counts to two"));
  await page.getByText(/count is 3, not 0/).waitFor();
  assert.equal(await page.locator('.strip .steps li[data-done="true"]').count(), 0);
  await run(lesson.steps[1].program);
  await page.locator('.strip .steps li[data-done="true"]').waitFor();
  await page.leave();
});

test("a step that does not count says what it still needs", async () => {
  await begin("and");
  const missing = here.page.locator(".strip .missing li");
  assert.equal(await missing.count(), 0);
  await typeProgram(
    here.page,
    'circuit both(a, b) -> (q) {\n    q = a and b\n}\ntest both "mine" {\n    a b | q\n    1 1 | 1\n}\n',
  );
  await compiled(here.page);
  await here.page.locator("#tab-tests").click();
  await here.page.locator("[data-do=all-logic]").click();
  await missing.getByText("every line of the lesson’s tests and claims is still there").waitFor();
  await missing.getByText("all robots of the circuit are nand").waitFor();
  assert.equal(await here.page.locator('.strip li[data-done="true"]').count(), 0);
  await here.page.locator("#tab-learn").click();
});

test("a lesson begins again with its program and its swarm, and what was written can be had back", async () => {
  await begin("latch");
  const code = here.page.locator(".cm-content");
  const own = "circuit broken(a) -> (q) {\n    q = b\n}\n";
  await typeProgram(here.page, own);
  await here.page.locator('.swarm .status[data-state="errors"]').waitFor();
  await here.page.locator(".strip [data-do=again]").click();
  await here.page.locator('.swarm .status[data-state="ready"]').waitFor();
  assert.match(await code.textContent(), /circuit d_latch/);
  await setInput(here.page, "d", 1);
  await setInput(here.page, "e", 1);
  await done(here.page, 1);
  await here.page.locator(".strip [data-do=again]").click();
  await here.page.locator("[data-do=play][data-running=true]").waitFor();
  await cyclesLater(here.page, 8);
  assert.equal(await here.page.locator('.strip li[data-done="true"]').count(), 0);
  assert.equal(await here.page.locator('button[data-input="d"]').getAttribute("aria-checked"), "false");
  // Both ways back: the kept programs, also after a reload, and the editor's undo.
  await here.page.reload();
  await walking(here.page);
  await here.page.locator(".strip [data-do=kept]").click();
  await here.page.locator(".strip [data-do=bring-back]").first().click();
  await here.page.locator('.swarm .status[data-state="errors"]').waitFor();
  assert.match(await code.textContent(), /circuit broken/);
  await code.click();
  await here.page.keyboard.press("Control+z");
  await here.page.locator('.swarm .status[data-state="ready"]').waitFor();
  assert.match(await code.textContent(), /circuit d_latch/);
});

test("another lesson leaves the program of this one as it is", async () => {
  await typeProgram(here.page, `${LATCH}\n// mine\n`);
  await begin("gate");
  await begin("latch");
  assert.match(await here.page.locator(".cm-content").textContent(), /\/\/ mine/);
  await here.page.locator(".strip [data-do=leave]").click();
  await here.page.locator(".strip").waitFor({ state: "hidden" });
});

test("a lesson goes on with its program where that was saved", async () => {
  const shows = name => here.page.waitForFunction(file => document.querySelector(".file").textContent === file, name);
  await begin("not");
  await typeProgram(here.page, `${LATCH}\n// saved\n`);
  await here.page.locator("[data-do=save]").click();
  await here.page.getByLabel("Path within the folder").fill("mine.nb");
  await here.page.locator("[data-do=save-as]").click();
  await shows("mine.nb");
  await begin("gate");
  await here.page.locator("#tab-learn").click();
  await here.page.locator('[data-lesson="not"] [data-do=begin]').click();
  await shows("mine.nb");
  assert.match(await here.page.locator(".cm-content").textContent(), /\/\/ saved/);
  // From the beginning, it is the program of the lesson.
  await here.page.locator(".strip [data-do=again]").click();
  assert.doesNotMatch(await here.page.locator(".cm-content").textContent(), /\/\/ saved/);
});

test("a circuit that is too large has fewer stars, until it is smaller", async () => {
  const and = lessonsOf(SHIPPED).find(({ name }) => name === "and");
  const long = and.steps[0].program.replace("q = t nand t", "u = t nand t\n    v = u nand u\n    q = v nand v");
  await begin("and");
  await typeProgram(here.page, long);
  await here.page.locator("#tab-tests").click();
  await here.page.locator("[data-do=all-logic]").click();
  const score = here.page.locator(".strip .score");
  await here.page.locator('.strip .score[data-size="4"][data-stars="1"]').waitFor();
  assert.match(await score.textContent(), /Your circuit: 4 gates in the text\. The smallest known has 2\./);
  await typeProgram(here.page, and.steps[0].program);
  await here.page.locator("[data-do=all-logic]").click();
  await here.page.locator('.strip .score[data-size="2"][data-stars="3"]').waitFor();
  assert.match(await score.textContent(), /No smaller one is known/);
  await here.page.locator("#tab-learn").click();
  await here.page.locator('[data-lesson="and"] .score[data-size="2"]').waitFor();
  await here.page.reload();
  await here.page.locator('[data-lesson="and"][data-finished="true"] .score[data-size="2"]').waitFor();
});

test(
  "the example of the manual is a lesson, and a mistake is shown with its line",
  { skip: needs("server") },
  async () => {
    const manual = readFileSync(new URL("../../docs/lessons.md", import.meta.url), "utf8");
    const example = /^````markdown\n([\s\S]*?)^````$/m.exec(manual)[1];
    const place = folderWith({});
    const course = path.join(place.folder, "my-course");
    mkdirSync(course);
    writeFileSync(path.join(course, "01-light.md"), example);
    const program = await play(place.folder, undefined, { more: ["--lessons", "my-course"] });
    const page = await visit(program.url);
    await page.locator(".speed").selectOption("16×");
    const [lesson] = lessonsOf(course);
    await playLesson(page, lesson);
    await page.locator("#tab-learn").click();
    assert.equal(await page.locator(".lesson").count(), 1);
    writeFileSync(path.join(course, "02-wrong.md"), example.replace("tests pass", "tests pas"));
    await page.reload();
    const finding = page.locator(".finding");
    await finding.waitFor();
    assert.match(await finding.textContent(), /02-wrong\.md:\d+: unknown word `pas` did you mean `pass`\?/);
    await page.leave();
    await program.stop();
    place.remove();
  },
);
