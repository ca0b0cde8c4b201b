// The tab with the lessons: their cards, where the course stands, and what begins a lesson.

import type { Connection } from "../connection";
import { button, element, fill } from "../element";
import type { TabName } from "../layout";
import type { LiveSwarm } from "../live/swarm";
import { own, recall, remember } from "../memory";
import type { Program } from "../program";
import type { Finding, LessonEntry } from "../protocol";
import type { RobotsPanel } from "../robots/panel";
import type { TestsPanel } from "../tests/panel";
import { prefersStillness } from "../theme";
import type { ClassPanel } from "./class";
import { HiddenTests } from "./hidden";
import { keepProgram, noteSavedFile, savedFile } from "./kept";
import { isLessonPath, lessonPath, stepAddress, type Lessons } from "./lessons";
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
  open: (path: string, text: string) => void;
  /** Opens a file, or, if it is gone, a program without a file. */
  openSaved: (saved: string, path: string, text: string) => void;
  replace: (text: string) => void;
  show: (tab: TabName) => void;
  moved: () => void;
  begun: () => void;
}

export class LearnPanel {
  readonly host = element("div", { class: "learn" });
  readonly strip: Strip;
  readonly #progress = new Progress();
  readonly #hidden: HiddenTests;
  readonly #cards = element("div", { class: "course" });
  #lesson: LessonEntry | null = null;
  #step = 0;
  #isAsked = false;
  /** The size of the present circuit, where the lesson asks for one. */
  #size: number | null = null;
  #missing: string[] = [];

  constructor(
    connection: Connection,
    private readonly parts: LearnParts,
    private readonly lessons: Lessons,
    private readonly doors: LearnDoors,
    private readonly course: ClassPanel,
  ) {
    this.strip = new Strip(this.#progress, {
      again: lesson => this.#again(lesson),
      bringBack: (lesson, text) => this.#bringBack(lesson, text),
      begin: lesson => this.#begin(lesson),
      resume: lesson => this.openStep(lesson, this.#step),
      why: () => this.#ask(),
      leave: () => this.#leave(),
    });
    this.host.append(course.host, this.#cards);
    const check = (): void => this.#check();
    this.#hidden = new HiddenTests(connection, parts.program, check);
    parts.swarm.frame.on(check);
    parts.swarm.definition.on(check);
    parts.tests.states.on(check);
    parts.tests.claims.states.on(check);
    parts.program.checked.on(check);
    parts.program.stage.on(check);
    parts.program.saved.on(saved => saved !== null && this.#noteFile(saved.from, saved.path));
    parts.robots.designer.design.on(check);
    parts.robots.evolution.search.on(check);
    lessons.list.on(() => {
      const lesson = lessons.named(this.#lesson?.name ?? recall(own("lesson")));
      if (lesson !== null && this.#lesson === null) {
        this.#step = this.#progress.next(lesson);
      }
      this.#lesson = lesson;
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
    this.strip.showPlace(this.#isHere(lesson) || this.parts.program.path.value === "");
    if (!this.#isHere(lesson)) {
      this.#note([]);
      return;
    }
    const situation = situationOf({ ...this.parts, hidden: this.#hidden });
    if (situation.tests > 0 && situation.passed === situation.tests) {
      const checks = lesson.steps[this.#step]?.checks ?? [];
      checks.forEach(check => check.is === "passes" && void this.#hidden.run(check.test));
    }
    const advanced = this.#progress.advance(lesson, this.#step, situation);
    if (advanced) {
      this.strip.fold();
      this.#move(lesson, this.#progress.next(lesson, this.#step));
      this.doors.moved();
    }
    const isDone = this.#progress.steps(lesson).has(this.#step);
    this.#note(isDone ? [] : missing(lesson, this.#step, situation, this.#isAsked));
    const size = this.#progress.isFinished(lesson) ? sizeOf(lesson, situation) : null;
    const better = size !== null && this.#progress.noteSize(lesson, size);
    if (advanced || better || size !== this.#size) {
      this.#size = size;
      this.#show();
    }
  }

  #isHere(lesson: LessonEntry): boolean {
    return lesson.program === null || this.#isOpen(lesson);
  }

  get address(): string | null {
    const lesson = this.#lesson;
    return lesson !== null && this.#isHere(lesson) ? stepAddress(lesson, this.#step) : null;
  }

  /** Shows a step of a lesson, with its program; in the tab of the lesson, if that is to be shown. */
  openStep(lesson: LessonEntry, step: number, showsTab = true): void {
    this.#take(lesson, Math.min(step, lesson.steps.length - 1));
    if (lesson.program !== null) {
      this.#open(lesson, lesson.program, savedFile(this.parts.program.folder, lesson.name));
    }
    if (showsTab) {
      this.doors.show(lesson.tab);
    }
    // A file that is still being read is shown later.
    if (this.#isHere(lesson)) {
      this.doors.moved();
    }
    this.#show();
  }

  #take(lesson: LessonEntry, step: number): void {
    this.#lesson = lesson;
    this.#size = null;
    remember(own("lesson"), lesson.name);
    this.doors.begun();
    this.#move(lesson, step);
  }

  /** Goes to a step; past the last one, the last stays. */
  #move(lesson: LessonEntry, step: number): void {
    this.#step = Math.min(step, lesson.steps.length - 1);
    this.#isAsked = false;
    this.#missing = [];
    this.strip.showMissing([]);
  }

  #ask(): void {
    this.#isAsked = true;
    this.#check();
  }

  #isOpen(lesson: LessonEntry): boolean {
    const { folder, path } = this.parts.program;
    return isLessonPath(lesson, path.value) || path.value === savedFile(folder, lesson.name);
  }

  #note(needed: string[]): void {
    if (needed.join() !== this.#missing.join()) {
      this.#missing = needed;
      this.strip.showMissing(needed);
    }
  }

  #begin(lesson: LessonEntry): void {
    if (this.#progress.isFinished(lesson)) {
      this.#take(lesson, 0);
      this.#again(lesson);
    } else {
      this.openStep(lesson, this.#progress.next(lesson));
    }
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
    this.#move(lesson, 0);
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
    this.doors.moved();
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

  #bringBack(lesson: LessonEntry, text: string): void {
    this.#open(lesson, lesson.program ?? "");
    this.#replace(lesson, text);
    this.#show();
  }

  #leave(): void {
    this.#lesson = null;
    remember(own("lesson"), null);
    this.doors.moved();
    this.#show();
    this.doors.show("learn");
  }

  #show(): void {
    const all = this.lessons.list.value;
    const finished = all.filter(lesson => this.#progress.isFinished(lesson)).length;
    const next = this.#lesson ?? all.find(one => !this.#progress.isFinished(one)) ?? null;
    fill(
      this.#cards,
      ...this.lessons.findings.map(findingElement),
      element(
        "p",
        { class: "row" },
        next !== null &&
          button(`Go on: ${next.title}`, () => this.#begin(next), { class: "primary", "data-do": "go-on" }),
        element("span", { class: "dim" }, `${finished} of ${all.length} lessons are done.`),
      ),
      ...this.#chapters(all),
    );
    const lesson = this.#lesson;
    this.strip.show(lesson, {
      folder: this.parts.program.folder,
      step: this.#step,
      size: this.#size,
      place: lesson === null ? "" : `${all.indexOf(lesson) + 1} of ${all.length}`,
      next: lesson === null ? null : this.lessons.after(lesson),
    });
    this.course.tell(
      lesson === null ? null : { lesson: lesson.name, done: this.#place(lesson), size: this.#progress.size(lesson) },
      finished,
    );
  }

  /** How many steps there are before the one that is shown; all if the lesson is finished. */
  #place(lesson: LessonEntry): number {
    return this.#progress.isFinished(lesson) ? lesson.steps.length : this.#step;
  }

  #chapters(all: LessonEntry[]): HTMLElement[] {
    const parts: HTMLElement[] = [];
    let list = element("ol", { class: "lessons" });
    all.forEach((lesson, i) => {
      if (i === 0 || lesson.chapter !== null) {
        list = element("ol", { class: "lessons" });
        parts.push(...(lesson.chapter === null ? [] : [element("h2", {}, lesson.chapter)]), list);
      }
      list.append(this.#entry(lesson, i));
    });
    return parts;
  }

  /** A lesson with what begins it; its text and steps are folded away. */
  #entry(lesson: LessonEntry, index: number): HTMLElement {
    const done = this.#progress.steps(lesson);
    const finished = this.#progress.isFinished(lesson);
    const label = finished ? "Do it again" : done.size > 0 || lesson === this.#lesson ? "Go on" : "Begin";
    return element(
      "li",
      { class: "lesson", "data-lesson": lesson.name, "data-finished": finished },
      element(
        "details",
        {},
        element(
          "summary",
          {},
          element("span", { class: "number", "aria-hidden": "true" }, finished ? "✓" : String(index + 1)),
          element("h3", {}, lesson.title),
        ),
        ...lesson.text.map(text => element("p", {}, ...prose(text))),
        element("ul", { class: "steps" }, ...lesson.steps.map((step, i) => stepElement(step.task, done.has(i)))),
      ),
      scoreElement(lesson, this.#progress.size(lesson), "Your smallest so far:"),
      button(label, () => this.#begin(lesson), { "aria-label": `${label}: ${lesson.title}`, "data-do": "begin" }),
    );
  }
}

function findingElement({ message, help, labels }: Finding): HTMLElement {
  const place = labels[0] === undefined ? "" : `${labels[0].file}:${labels[0].start.line}: `;
  return element(
    "p",
    { class: "finding", role: "alert" },
    `${place}${message}`,
    help !== null && element("span", { class: "dim" }, ` ${help}`),
  );
}
