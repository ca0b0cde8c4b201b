// The tab with the lessons, and the strip that shows the present step in the other tabs.

import { button, element, fill, iconButton } from "../element";
import type { TabName } from "../layout";
import type { LiveSwarm } from "../live/swarm";
import { recall, remember } from "../memory";
import type { Program } from "../program";
import type { RobotsPanel } from "../robots/panel";
import type { TestsPanel } from "../tests/panel";
import { prefersStillness } from "../theme";
import { LESSONS, lessonPath, type Lesson } from "./lessons";
import { Progress } from "./progress";
import { situationOf } from "./situation";

interface Parts {
  program: Program;
  swarm: LiveSwarm;
  tests: TestsPanel;
  robots: RobotsPanel;
}

interface Doors {
  /** Opens a program without a file. */
  open: (path: string, text: string) => void;
  /** Replaces the text of the program. */
  replace: (text: string) => void;
  show: (tab: TabName) => void;
}

export class LearnPanel {
  readonly host = element("div", { class: "learn" });
  readonly strip = element("aside", { class: "strip", "aria-label": "Lesson", "aria-live": "polite", hidden: true });
  readonly #progress = new Progress();
  readonly #restoring = button("Restore the program", () => this.#onRestore(), {
    "data-do": "restore",
    title: "Begin again with the program of this lesson",
  });
  #onRestore = (): void => {};
  #lesson: Lesson | null = LESSONS.find(lesson => lesson.name === recall("lesson")) ?? null;

  constructor(
    private readonly parts: Parts,
    private readonly doors: Doors,
  ) {
    const check = (): void => this.#check();
    parts.swarm.frame.on(check);
    parts.tests.states.on(check);
    parts.program.checked.on(check);
    parts.program.checked.on(() => this.#offerRestoring());
    parts.program.path.on(() => this.#offerRestoring());
    parts.robots.designer.design.on(check);
    parts.robots.evolution.search.on(check);
    this.#show();
  }

  #check(): void {
    const lesson = this.#lesson;
    // A lesson's program must be there, so that a chance agreement elsewhere does not count.
    if (lesson === null || (lesson.program !== null && this.parts.program.path.value !== lessonPath(lesson))) {
      return;
    }
    if (this.#progress.advance(lesson, situationOf(this.parts))) {
      this.#show();
    }
  }

  #begin(lesson: Lesson): void {
    this.#lesson = lesson;
    remember("lesson", lesson.name);
    const again = this.#progress.isFinished(lesson);
    if (again) {
      this.#progress.restart(lesson);
    }
    if (lesson.program !== null) {
      this.#open(lesson, lesson.program, again);
    }
    this.doors.show(lesson.tab);
    this.#show();
  }

  /** Opens the program of a lesson. Its swarm runs, with all inputs off, so that no step is done before it is begun. */
  #open(lesson: Lesson, text: string, again: boolean): void {
    const { program, swarm } = this.parts;
    const isOpen = program.path.value === lessonPath(lesson);
    if (!isOpen || again) {
      swarm.setClock(null);
      swarm.setInputs(swarm.inputs.value.replaceAll("1", "0"));
    }
    if (isOpen && again) {
      swarm.reset();
    }
    if (isOpen && !prefersStillness()) {
      swarm.play();
    }
    if (!isOpen) {
      program.plays = !prefersStillness();
      this.doors.open(lessonPath(lesson), text);
    }
  }

  /** Brings back the program of the lesson, in a way that can be undone. */
  #restore(lesson: Lesson, text: string): void {
    if (this.parts.program.path.value === lessonPath(lesson)) {
      this.doors.replace(text);
    } else {
      this.#open(lesson, text, false);
    }
  }

  #leave(): void {
    this.#lesson = null;
    remember("lesson", null);
    this.#show();
  }

  #show(): void {
    const finished = LESSONS.filter(lesson => this.#progress.isFinished(lesson)).length;
    fill(
      this.host,
      element(
        "p",
        { class: "dim" },
        `Eight short lessons, each with something to do. ${finished} of ${LESSONS.length} are done.`,
      ),
      element("ol", { class: "lessons" }, ...LESSONS.map((lesson, i) => this.#card(lesson, i))),
    );
    this.#showStrip();
  }

  #card(lesson: Lesson, index: number): HTMLElement {
    const done = this.#progress.done(lesson);
    const finished = this.#progress.isFinished(lesson);
    const label = finished ? "Do it again" : done > 0 || lesson === this.#lesson ? "Go on" : "Begin";
    const suggested = lesson === (this.#lesson ?? this.#progress.next());
    return element(
      "li",
      { class: "card lesson", "data-lesson": lesson.name, "data-finished": finished },
      element(
        "header",
        {},
        element("span", { class: "number", "aria-hidden": "true" }, finished ? "✓" : String(index + 1)),
        element("h3", {}, lesson.title),
      ),
      ...lesson.text.map(text => element("p", {}, text)),
      element("ul", { class: "steps" }, ...lesson.steps.map((step, i) => stepElement(step.task, i < done))),
      button(label, () => this.#begin(lesson), { class: suggested && !finished ? "primary" : "", "data-do": "begin" }),
    );
  }

  /** A program that was changed, or that is not open any more, can be had back. */
  #offerRestoring(): void {
    const lesson = this.#lesson;
    const text = lesson?.program ?? null;
    const { program } = this.parts;
    this.#restoring.hidden =
      lesson === null || text === null || (program.path.value === lessonPath(lesson) && program.text === text);
    this.#onRestore = () => lesson !== null && text !== null && this.#restore(lesson, text);
  }

  #showStrip(): void {
    const lesson = this.#lesson;
    this.strip.hidden = lesson === null;
    if (lesson === null) {
      return;
    }
    const done = this.#progress.done(lesson);
    const finished = this.#progress.isFinished(lesson);
    const next = LESSONS[LESSONS.indexOf(lesson) + 1];
    this.#offerRestoring();
    this.strip.dataset["finished"] = String(finished);
    fill(
      this.strip,
      element(
        "div",
        { class: "said" },
        element("h3", {}, lesson.title),
        element("p", { class: "about" }, lesson.text.join(" ")),
        element(
          "ul",
          { class: "steps" },
          ...lesson.steps.slice(0, done + 1).map((step, i) => stepElement(step.task, i < done)),
        ),
        finished &&
          element("p", { class: "pass" }, next === undefined ? "Well done. That was the last lesson." : "Well done."),
      ),
      this.#restoring,
      finished &&
        next !== undefined &&
        button(`Next: ${next.title}`, () => this.#begin(next), { class: "primary", "data-do": "next" }),
      iconButton("close", "Leave the lesson", () => this.#leave()),
    );
  }
}

function stepElement(task: string, done: boolean): HTMLElement {
  return element(
    "li",
    { "data-done": done },
    element("span", { class: "box", role: "img", "aria-label": done ? "done" : "to do" }, done ? "✓" : ""),
    element("span", {}, task),
  );
}
