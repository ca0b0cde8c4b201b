// The teacher's page: who is at which lesson and step. Names are text and nothing else.

import { counted } from "../counted";
import { element, fill } from "../element";
import { prose } from "../learn/prose";
import type { ClassCourse, ClassLesson, ClassMember, ClassRoll } from "../protocol";

/** The time between two questions, and how long a learner may be at a step before it is marked. */
const PAUSE = 2000;
const LONG = 300;

export class Board {
  readonly host = element("main", { class: "board" });
  readonly #status = element("p", { class: "status", role: "status" });
  readonly #table = element("div", { class: "scroll" });
  #lessons: ClassLesson[] = [];

  constructor() {
    this.host.append(element("h1", {}, "Class"), this.#status, this.#table);
  }

  async start(): Promise<void> {
    for (;;) {
      try {
        if (this.#lessons.length === 0) {
          this.#lessons = (await ask<ClassCourse>("lessons")).lessons;
        }
        this.#show(await ask<ClassRoll>("members"));
      } catch {
        this.#status.textContent = "The server does not answer. Trying again …";
      }
      await new Promise(resolve => setTimeout(resolve, PAUSE));
    }
  }

  #show({ members, most }: ClassRoll): void {
    this.#status.textContent =
      members.length === 0
        ? "Nobody has joined yet. Learners join in the tab Learn of their page."
        : `${members.length} of at most ${most} have joined`;
    if (members.length === 0) {
      fill(this.#table);
      return;
    }
    const head = ["Name", "Lesson", "Step", "For", "Finished"].map(name => element("th", { scope: "col" }, name));
    fill(
      this.#table,
      element(
        "table",
        {},
        element("thead", {}, element("tr", {}, ...head)),
        element("tbody", {}, ...members.map(member => this.#row(member))),
      ),
    );
  }

  #row({ name, place, finished, seconds }: ClassMember): HTMLElement {
    const lesson = this.#lessons.find(lesson => lesson.name === place?.lesson);
    const steps = lesson?.steps ?? [];
    const done = Math.min(place?.done ?? 0, steps.length);
    const isDone = lesson !== undefined && done === steps.length;
    return element(
      "tr",
      { "data-member": name, "data-long": place !== null && !isDone && seconds > LONG },
      element("th", { scope: "row" }, name),
      element("td", {}, lesson === undefined ? "–" : lesson.title),
      element(
        "td",
        {},
        lesson !== undefined && element("progress", { max: steps.length, value: done, "aria-hidden": "true" }),
        stepText(lesson, done),
        !isDone && element("span", { class: "task" }, ...prose(steps[done] ?? "")),
        place?.size != null && element("span", { class: "task" }, `smallest circuit: ${place.size}`),
      ),
      element("td", {}, place === null ? "" : timeText(seconds)),
      element("td", {}, `${finished} of ${this.#lessons.length}`),
    );
  }
}

function stepText(lesson: ClassLesson | undefined, done: number): string {
  if (lesson === undefined) {
    return "";
  }
  const { length } = lesson.steps;
  return done === length ? `${counted(length, "step")} done` : `step ${done + 1} of ${length}`;
}

function timeText(seconds: number): string {
  return seconds < 60 ? "less than a minute" : `${Math.floor(seconds / 60)} min`;
}

async function ask<T>(what: string): Promise<T> {
  const answer = await fetch(new URL(what, document.baseURI), { cache: "no-store" });
  if (!answer.ok) {
    throw new Error(answer.statusText);
  }
  return (await answer.json()) as T;
}
