// The tab with the lessons: their cards, where the course stands, and what begins a lesson.

import { button, element, fill } from "../element";
import type { TabName } from "../layout";
import type { LiveSwarm } from "../live/swarm";
import { recall, remember } from "../memory";
import type { Program } from "../program";
import type { Finding, LessonEntry } from "../protocol";
import type { RobotsPanel } from "../robots/panel";
import type { TestsPanel } from "../tests/panel";
import { prefersStillness } from "../theme";
import type { ClassPanel } from "./class";
import { keepProgram, noteSavedFile, savedFile } from "./kept";
import { isLessonPath, lessonPath, type Lessons } from "./lessons";
import { Progress } from "./progress";
import { missing } from "./missing";
import { prose } from "./prose";
import { sizeOf } from "./score";
import { situationOf } from "./situation";
import { Strip, scoreElement, stepElement } from "./strip";

export interface LearnParts {
  program: Program;
  swarm: LiveSwarm;
  tests: TestsPanel;
  robots: RobotsPanel;
}

export interface LearnDoors {
  /** Opens a program without a file. */
  open: (path: string, text: string) => void;
  /** Opens a file, or, if it is gone, a program without a file. */
  openSaved: (saved: string, path: string, text: string) => void;
  /** Replaces the text of the program. */
  replace: (text: string) => void;
  show: (tab: TabName) => void;
}

export class LearnPanel {
  readonly host = element("div", { class: "learn" });
  readonly strip: Strip;
  readonly #progress = new Progress();
  readonly #cards = element("div", { class: "course" });
  #lesson: LessonEntry | null = null;
  /** The size of the present circuit, where the lesson asks for one. */
  #size: number | null = null;
  /** What the present step still needs, once a part of it is done. */
  #missing: string[] = [];

  constructor(
    private readonly parts: LearnParts,
    private readonly lessons: Lessons,
    private readonly doors: LearnDoors,
    private readonly course: ClassPanel,
  ) {
    this.strip = new Strip(this.#progress, {
      again: lesson => this.#again(lesson),
      bringBack: (lesson, text) => this.#bringBack(lesson, text),
      begin: lesson => this.#begin(lesson),
      leave: () => this.#leave(),
    });
    this.host.append(course.host, this.#cards);
    const check = (): void => this.#check();
    parts.swarm.frame.on(check);
    parts.swarm.definition.on(check);
    parts.tests.states.on(check);
    parts.program.checked.on(check);
    parts.program.stage.on(check);
    parts.program.saved.on(saved => saved !== null && this.#noteFile(saved.from, saved.path));
    parts.robots.designer.design.on(check);
    parts.robots.evolution.search.on(check);
    lessons.list.on(() => {
      this.#lesson = lessons.named(this.#lesson?.name ?? recall("lesson"));
      this.#show();
    });
    this.#show();
  }

  #check(): void {
    const lesson = this.#lesson;
    if (lesson === null) {
      return;
    }
    // A lesson's program must be there, so that a chance agreement elsewhere does not count.
    if (lesson.program !== null && !this.#isOpen(lesson)) {
      const isNone = this.parts.program.path.value === "";
      this.#note(isNone ? [] : [`the lesson’s program ${lessonPath(lesson)} is open in the editor`]);
      return;
    }
    const situation = situationOf(this.parts);
    const advanced = this.#progress.advance(lesson, situation);
    this.#note(missing(lesson, this.#progress.done(lesson), situation));
    const size = this.#progress.isFinished(lesson) ? sizeOf(lesson, situation) : null;
    const better = size !== null && this.#progress.noteSize(lesson, size);
    if (advanced || better || size !== this.#size) {
      this.#size = size;
      this.#show();
    }
  }

  #isOpen(lesson: LessonEntry): boolean {
    const { folder, path } = this.parts.program;
    return isLessonPath(lesson, path.value) || path.value === savedFile(folder, lesson.name);
  }

  /** Notes what a step still needs. */
  #note(needed: string[]): void {
    if (needed.join() !== this.#missing.join()) {
      this.#missing = needed;
      this.#show();
    }
  }

  #begin(lesson: LessonEntry): void {
    this.#lesson = lesson;
    this.#size = null;
    remember("lesson", lesson.name);
    if (this.#progress.isFinished(lesson)) {
      this.#again(lesson);
      return;
    }
    if (lesson.program !== null) {
      this.#open(lesson, lesson.program, savedFile(this.parts.program.folder, lesson.name));
    }
    this.doors.show(lesson.tab);
    this.#show();
  }

  /** Notes where the program of a lesson was saved, to go on with it. */
  #noteFile(from: string, path: string): void {
    const { folder } = this.parts.program;
    const isOf = (lesson: LessonEntry): boolean =>
      isLessonPath(lesson, from) || isLessonPath(lesson, path) || savedFile(folder, lesson.name) === from;
    for (const lesson of this.lessons.list.value.filter(isOf)) {
      noteSavedFile(folder, lesson.name, path);
    }
  }

  /** Starts a lesson again: its program, its swarm and its steps. What was written is kept. */
  #again(lesson: LessonEntry): void {
    const { swarm } = this.parts;
    this.#progress.restart(lesson);
    this.#size = null;
    if (lesson.program !== null) {
      const wasOpen = this.#isOpen(lesson);
      this.#open(lesson, lesson.program);
      this.#replace(lesson, lesson.program);
      const { folder, path } = this.parts.program;
      if (path.value !== savedFile(folder, lesson.name)) {
        noteSavedFile(folder, lesson.name, null);
      }
      if (wasOpen) {
        swarm.setClock(null);
        swarm.setInputs(swarm.inputs.value.replaceAll("1", "0"));
        swarm.reset();
        if (!prefersStillness()) {
          swarm.play();
        }
      }
    }
    this.doors.show(lesson.tab);
    this.#show();
  }

  /**
   * Opens the program of a lesson, or the file in which it was saved. Its swarm runs, with all inputs off, so that no
   * step is done before it is begun.
   */
  #open(lesson: LessonEntry, text: string, saved: string | null = null): void {
    const { program, swarm } = this.parts;
    if (!this.#isOpen(lesson)) {
      swarm.setClock(null);
      swarm.setInputs(swarm.inputs.value.replaceAll("1", "0"));
      program.plays = !prefersStillness();
      if (saved === null) {
        this.doors.open(lessonPath(lesson), text);
      } else {
        this.doors.openSaved(saved, lessonPath(lesson), text);
      }
    } else if (!prefersStillness()) {
      swarm.play();
    }
  }

  /** Replaces the program of a lesson that is open, in a way that can be undone, and keeps what was there. */
  #replace(lesson: LessonEntry, text: string): void {
    const { program } = this.parts;
    const before = program.text;
    if (before === text) {
      return;
    }
    if (before !== lesson.program && before.trim() !== "") {
      keepProgram(program.folder, lesson.name, { text: before, at: Date.now() });
    }
    this.doors.replace(text);
  }

  /** Brings back a program that was replaced. */
  #bringBack(lesson: LessonEntry, text: string): void {
    this.#open(lesson, lesson.program ?? "");
    this.#replace(lesson, text);
    this.#show();
  }

  #leave(): void {
    this.#lesson = null;
    remember("lesson", null);
    this.#show();
    this.doors.show("learn");
  }

  #show(): void {
    const all = this.lessons.list.value;
    const finished = all.filter(lesson => this.#progress.isFinished(lesson)).length;
    fill(
      this.#cards,
      ...this.lessons.findings.map(findingElement),
      element("p", { class: "dim" }, `${finished} of ${all.length} lessons are done.`),
      element("ol", { class: "lessons" }, ...all.map((lesson, i) => this.#card(lesson, i))),
    );
    const lesson = this.#lesson;
    this.strip.show(lesson, {
      folder: this.parts.program.folder,
      size: this.#size,
      missing: this.#missing,
      place: lesson === null ? "" : `${all.indexOf(lesson) + 1} of ${all.length}`,
      next: lesson === null ? null : this.lessons.after(lesson),
    });
    this.course.tell(
      lesson === null
        ? null
        : { lesson: lesson.name, done: this.#progress.done(lesson), size: this.#progress.size(lesson) },
      finished,
    );
  }

  #card(lesson: LessonEntry, index: number): HTMLElement {
    const done = this.#progress.done(lesson);
    const finished = this.#progress.isFinished(lesson);
    const label = finished ? "Do it again" : done > 0 || lesson === this.#lesson ? "Go on" : "Begin";
    const next = this.lessons.list.value.find(other => !this.#progress.isFinished(other));
    const suggested = lesson === (this.#lesson ?? next);
    return element(
      "li",
      { class: "card lesson", "data-lesson": lesson.name, "data-finished": finished },
      element(
        "header",
        {},
        element("span", { class: "number", "aria-hidden": "true" }, finished ? "✓" : String(index + 1)),
        element("h3", {}, lesson.title),
      ),
      ...lesson.text.map(text => element("p", {}, ...prose(text))),
      element("ul", { class: "steps" }, ...lesson.steps.map((step, i) => stepElement(step.task, i < done))),
      scoreElement(lesson, this.#progress.size(lesson), "Your smallest so far:"),
      button(label, () => this.#begin(lesson), {
        class: suggested && !finished ? "primary" : "",
        "aria-label": `${label}: ${lesson.title}`,
        "data-do": "begin",
      }),
    );
  }
}

/** What is wrong with a lesson of an author. */
function findingElement({ message, help, labels }: Finding): HTMLElement {
  const place = labels[0] === undefined ? "" : `${labels[0].file}:${labels[0].start.line}: `;
  return element(
    "p",
    { class: "finding", role: "alert" },
    `${place}${message}`,
    help !== null && element("span", { class: "dim" }, ` ${help}`),
  );
}
