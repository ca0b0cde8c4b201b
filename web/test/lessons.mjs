// Plays lessons: reads their files, and does what the `do` lines of their steps say (docs/lessons.md).

import { readFileSync, readdirSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";

import { cyclesLater, setInput, typeProgram } from "./browser.mjs";

export const SHIPPED = fileURLToPath(new URL("../../lessons", import.meta.url));

/** The lessons of a folder: their names, goals, programs, and the deeds of their steps. */
export function lessonsOf(folder) {
  const files = readdirSync(folder).filter(file => file.endsWith(".md") && file !== "README.md");
  return files.sort().map(file => readLesson(file, readFileSync(path.join(folder, file), "utf8")));
}

export function readLesson(file, text) {
  const [head, ...parts] = text.split(/^## Step$/m);
  const program = /^```nb\n([\s\S]*?)^```$/m;
  return {
    name: file.replace(/^\d+-/, "").replace(/\.md$/, ""),
    title: /^# (.*)$/m.exec(head)[1],
    hasGoal: /^- best: /m.test(head),
    program: program.exec(head)?.[1] ?? null,
    steps: parts.map(part => ({
      deeds: [...part.matchAll(/^- do: (.*)$/gm)].map(found => found[1].trim().split(/\s+/)),
      program: program.exec(part)?.[1] ?? null,
    })),
  };
}

/** Begins a lesson and does all of its steps. */
export async function playLesson(page, lesson) {
  await page.locator("#tab-learn").click();
  await page.locator(`[data-lesson="${lesson.name}"] [data-do=begin]`).click();
  await page.locator(".strip h3", { hasText: lesson.title }).waitFor();
  if (lesson.program !== null) {
    await page.waitForFunction(
      file => document.querySelector(".file").textContent === file,
      `lesson_${lesson.name}.nb`,
    );
    await compiled(page);
  }
  for (const [index, step] of lesson.steps.entries()) {
    for (const deed of step.deeds) {
      await DEEDS[deed[0]](page, deed.slice(1), { step, isDone: () => isDone(page, index + 1) });
    }
    await done(page, index + 1);
  }
  await page.locator('.strip[data-finished="true"]').waitFor();
  if (lesson.hasGoal) {
    await page.locator('.strip .score[data-stars="3"]').waitFor();
  }
}

/** Waits until this many steps are done. */
export async function done(page, count) {
  await page
    .locator('.strip .steps li[data-done="true"]')
    .nth(count - 1)
    .waitFor();
}

async function isDone(page, count) {
  return (await page.locator('.strip .steps li[data-done="true"]').count()) >= count;
}

/** Waits until the program has been compiled. */
export async function compiled(page) {
  await page.waitForFunction(() => document.querySelector(".swarm .status").dataset.state === "ready");
}

const DEEDS = {
  set: async (page, words) => {
    await show(page, "swarm");
    for (const [name, value] of values(words)) {
      const number = page.locator(`input[data-input="${name}"]`);
      if ((await number.count()) > 0) {
        await number.selectText();
        await number.pressSequentially(String(value));
        await number.press("Enter");
      } else {
        await setInput(page, name, value);
      }
    }
  },
  await: async (page, words) => {
    await show(page, "swarm");
    await page.waitForFunction(wanted => {
      const shown = name =>
        document.querySelector(`[data-output="${name}"]`)?.textContent ??
        document.querySelector(`[data-lamp="${name}"]`)?.dataset.value;
      return wanted.every(([name, value]) => shown(name) === String(value));
    }, values(words));
  },
  wait: async (page, [cycles]) => {
    await show(page, "swarm");
    await cyclesLater(page, Number(cycles));
  },
  pulse: async (page, [name]) => {
    await show(page, "swarm");
    const input = value => page.locator(`button[data-input="${name}"][aria-checked="${value}"]`).waitFor();
    await page.locator("[data-do=pulse]").click();
    await input(true);
    await input(false);
  },
  clock: async page => {
    await show(page, "swarm");
    const button = page.locator("[data-do=clock]");
    if ((await button.getAttribute("aria-pressed")) !== "true") {
      await button.click();
    }
  },
  rewind: async (page, _, { isDone }) => {
    await show(page, "swarm");
    await page.locator("[data-do=play][data-running=true]").click();
    await page.locator("[data-do=play][data-running=false]").waitFor();
    const slider = page.locator(".rewind");
    await slider.focus();
    for (let cycle = Number(await slider.inputValue()) - 1; cycle >= 0 && !(await isDone()); cycle--) {
      await page.keyboard.press("ArrowLeft");
      // Each cycle is shown, so that none is skipped.
      await page.waitForFunction(
        shown => document.querySelector(".cycle").textContent.startsWith(`cycle ${shown} `),
        cycle,
      );
    }
  },
  circuit: async (page, [name]) => {
    await show(page, "swarm");
    await page.locator("select.circuit").selectOption({ label: name });
  },
  type: async (page, _, { step }) => {
    await typeProgram(page, step.program);
    // An edit is checked when typing pauses.
    await page.waitForTimeout(500);
    await compiled(page);
  },
  test: async (page, [level]) => {
    await show(page, "tests");
    await page.locator(`[data-do=all-${level}]`).click();
  },
  prove: async page => {
    await show(page, "tests");
    for (const button of await page.locator("[data-claim] [data-do=prove]").all()) {
      await button.click();
    }
  },
  watch: async page => {
    await show(page, "tests");
    await page.locator("[data-verdict=refuted] [data-do=watch]").first().click();
  },
  design: async (page, [robot]) => {
    await show(page, "robots");
    await page.locator(`[data-robot="${robot}"] [data-do=design]`).click();
  },
  mirror: page => page.locator("[data-do=mirror]").click(),
  random: async page => {
    await show(page, "robots");
    // The materials come with the robots of the library.
    await page.locator(".palette [role=radio]").first().waitFor();
    // The same body and the same search each time (Park and Miller's generator): others may need minutes.
    await page.evaluate(() => {
      let last = 1;
      Math.random = () => (last = (last * 16807) % 2147483647) / 2147483647;
    });
    await page.locator("[data-do=random]").click();
  },
  evolve: page => page.locator("[data-do=evolve]").click(),
  choose: page => page.locator(".niche:not(:disabled)").first().click(),
};

async function show(page, tab) {
  await page.locator(`#tab-${tab}`).click();
}

function values(words) {
  return words.map(word => word.split("=")).map(([name, value]) => [name, Number(value)]);
}
