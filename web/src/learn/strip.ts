// The strip above the tabs: the present lesson, its next step, hints, and how small the circuit is.

import { button, element, fill, iconButton } from "../element";
import { closeOutside } from "../menu";
import type { LessonEntry } from "../protocol";
import { keptPrograms } from "./kept";
import type { Progress } from "./progress";
import { prose } from "./prose";
import { STARS, sizeText, starsOf } from "./score";

interface StripDoors {
  /** Starts the lesson again. */
  again: (lesson: LessonEntry) => void;
  /** Brings back a program that was replaced. */
  bringBack: (lesson: LessonEntry, text: string) => void;
  begin: (lesson: LessonEntry) => void;
  leave: () => void;
}

interface Shown {
  folder: string;
  /** The size of the present circuit. */
  size: number | null;
  /** What the present step still needs. */
  missing: string[];
  /** Where the lesson is in the course. */
  place: string;
  next: LessonEntry | null;
}

export class Strip {
  readonly host = element("aside", { class: "strip", "aria-label": "Lesson", hidden: true });
  /** The hints that were asked for, of the step that they are about. */
  #hints = { step: "", shown: 0 };

  constructor(
    private readonly progress: Progress,
    private readonly doors: StripDoors,
  ) {}

  show(lesson: LessonEntry | null, shown: Shown): void {
    this.host.hidden = lesson === null;
    if (lesson === null) {
      return;
    }
    const done = this.progress.done(lesson);
    const finished = this.progress.isFinished(lesson);
    const focused = this.host.contains(document.activeElement)
      ? (document.activeElement as HTMLElement).dataset["do"]
      : undefined;
    this.host.dataset["finished"] = String(finished);
    fill(
      this.host,
      element(
        "div",
        { class: "said" },
        element("h3", {}, lesson.title, element("span", { class: "place" }, ` ${shown.place}`)),
        element("div", { class: "about" }, ...lesson.text.map(text => element("p", {}, ...prose(text)))),
        element(
          "div",
          { class: "todo" },
          element(
            "ul",
            { class: "steps", "aria-live": "polite" },
            ...lesson.steps.slice(0, done + 1).map((step, i) => stepElement(step.task, i < done)),
          ),
          !finished &&
            shown.missing.length > 0 &&
            element("p", { class: "missing", role: "status" }, `Not yet: ${shown.missing.join("; ")}.`),
          finished && element("p", { class: "pass", role: "status" }, praise(shown.next)),
          finished && scoreElement(lesson, shown.size, "Your circuit:"),
          ...this.#hintElements(lesson, done, shown),
        ),
      ),
      element("div", { class: "ways" }, ...this.#buttons(lesson, finished, shown)),
      iconButton("close", "Leave the lesson", () => this.doors.leave(), { "data-do": "leave" }),
    );
    if (focused !== undefined) {
      this.host.querySelector<HTMLElement>(`[data-do="${focused}"]`)?.focus();
    }
  }

  /** The hints that were asked for, and the button for another one. */
  #hintElements(lesson: LessonEntry, done: number, shown: Shown): (HTMLElement | false)[] {
    const step = lesson.steps[done];
    if (step === undefined) {
      return [];
    }
    const hints = step.hints.length > 0 ? step.hints : lesson.hints;
    const name = `${lesson.name} ${done}`;
    if (this.#hints.step !== name) {
      this.#hints = { step: name, shown: 0 };
    }
    const count = this.#hints.shown;
    const more = (): void => {
      this.#hints.shown++;
      this.show(lesson, shown);
    };
    const label = `${count === 0 ? "Hint" : "Another hint"} (${count + 1} of ${hints.length})`;
    return [
      count > 0 &&
        element(
          "ol",
          { class: "hints", role: "status", "aria-label": "Hints" },
          ...hints.slice(0, count).map(hint => element("li", {}, ...prose(hint))),
        ),
      count < hints.length && button(label, more, { class: "link", "data-do": "hint" }),
    ];
  }

  #buttons(lesson: LessonEntry, finished: boolean, shown: Shown): (HTMLElement | false)[] {
    const { next } = shown;
    const kept = keptPrograms(shown.folder, lesson.name);
    return [
      finished &&
        next !== null &&
        button(`Next: ${next.title}`, () => this.doors.begin(next), { class: "primary", "data-do": "next" }),
      button("Start again", () => this.doors.again(lesson), {
        "data-do": "again",
        title: "Begin this lesson again. What you have written is kept",
      }),
      kept.length > 0 &&
        this.#menu(
          kept.map(({ text, at }) => ({
            label: `${timeText(at)}, ${text.trim().split("\n").length} lines`,
            run: () => this.doors.bringBack(lesson, text),
          })),
        ),
    ];
  }

  #menu(entries: { label: string; run: () => void }[]): HTMLElement {
    const menu = element(
      "details",
      { class: "menu" },
      element("summary", { "data-do": "kept", title: "Bring back what you had written" }, "Your programs"),
      element(
        "div",
        { class: "sheet" },
        ...entries.map(({ label, run }) => button(label, run, { "data-do": "bring-back" })),
      ),
    );
    closeOutside(menu);
    return menu;
  }
}

export function stepElement(task: string, done: boolean): HTMLElement {
  return element(
    "li",
    { "data-done": done },
    element("span", { class: "box", role: "img", "aria-label": done ? "done" : "to do" }, done ? "✓" : ""),
    element("span", {}, ...prose(task)),
  );
}

/** The size of a circuit, the best one known, and stars. */
export function scoreElement(lesson: LessonEntry, size: number | null, words: string): HTMLElement | null {
  const { best } = lesson;
  if (best === null || size === null) {
    return null;
  }
  const stars = starsOf(size, best.number);
  const known = size <= best.number ? "No smaller one is known." : `The smallest known has ${best.number}.`;
  return element(
    "p",
    { class: "score", "data-size": size, "data-stars": stars },
    element(
      "span",
      { class: "stars", role: "img", "aria-label": `${stars} of ${STARS} stars` },
      "★".repeat(stars) + "☆".repeat(STARS - stars),
    ),
    ` ${words} ${sizeText(size, best.of)}. ${known}`,
  );
}

function praise(next: LessonEntry | null): string {
  return next === null ? "Well done. That was the last lesson." : "Well done.";
}

function timeText(at: number): string {
  const time = new Date(at);
  const today = new Date().toDateString() === time.toDateString();
  const hour = time.toLocaleTimeString([], { hour: "2-digit", minute: "2-digit" });
  return today ? hour : `${time.toLocaleDateString()}, ${hour}`;
}
