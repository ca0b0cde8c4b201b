// The strip above the tabs: the present lesson, its next step, hints, and how small the circuit is.

import { button, element, fill, iconButton } from "../element";
import { closeOutside } from "../menu";
import type { LessonEntry } from "../protocol";
import { own, recall, remember } from "../memory";
import { keptPrograms } from "./kept";
import { lessonPath, stepAddress } from "./lessons";
import type { Progress } from "./progress";
import { prose } from "./prose";
import { STARS, sizeText, starsOf } from "./score";

const READ = "lessons-read";

interface StripDoors {
  again: (lesson: LessonEntry) => void;
  bringBack: (lesson: LessonEntry, text: string) => void;
  begin: (lesson: LessonEntry) => void;
  resume: (lesson: LessonEntry) => void;
  why: () => void;
  leave: () => void;
}

interface Shown {
  folder: string;
  step: number;
  size: number | null;
  place: string;
  next: LessonEntry | null;
}

export class Strip {
  readonly host = element("aside", { class: "strip", "aria-label": "Lesson", hidden: true });
  /** The hints that were asked for, of the step that they are about. */
  #hints = { step: "", shown: 0 };
  #missing = missingElement([]);
  /** The lesson whose text was folded away or out, and which of these. */
  #text = { lesson: "", isOpen: true };

  constructor(
    private readonly progress: Progress,
    private readonly doors: StripDoors,
  ) {}

  showMissing(missing: string[]): void {
    const before = this.#missing;
    this.#missing = missingElement(missing);
    before.replaceWith(this.#missing);
  }

  showPlace(isHere: boolean): void {
    // This is called after each frame.
    if (this.host.dataset["away"] !== String(!isHere)) {
      this.host.dataset["away"] = String(!isHere);
    }
  }

  show(lesson: LessonEntry | null, shown: Shown): void {
    this.host.hidden = lesson === null;
    if (lesson === null) {
      return;
    }
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
        element(
          "div",
          { class: "top" },
          element("h3", {}, lesson.title, element("span", { class: "place" }, ` ${shown.place}`)),
          this.#steps(lesson, shown.step),
        ),
        this.#about(lesson),
        element(
          "div",
          { class: "todo" },
          element("p", { class: "task", "aria-live": "polite" }, ...prose(lesson.steps[shown.step]?.task ?? "")),
          this.#missing,
          finished && element("p", { class: "pass", role: "status" }, praise(shown.next)),
          finished && scoreElement(lesson, shown.size, "Your circuit:"),
          ...this.#hintElements(lesson, shown),
        ),
      ),
      element("div", { class: "ways" }, ...this.#buttons(lesson, finished, shown)),
      iconButton("close", "Leave the lesson", () => this.doors.leave(), { "data-do": "leave" }),
    );
    if (focused !== undefined) {
      this.host.querySelector<HTMLElement>(`[data-do="${focused}"]`)?.focus();
    }
  }

  #steps(lesson: LessonEntry, present: number): HTMLElement {
    const done = this.progress.steps(lesson);
    const link = (step: number): HTMLElement =>
      element(
        "a",
        {
          href: `#${stepAddress(lesson, step)}`,
          "aria-current": step === present ? "step" : null,
          "aria-label": `Step ${step + 1}, ${done.has(step) ? "done" : "to do"}`,
        },
        done.has(step) ? "✓" : String(step + 1),
      );
    return element(
      "ol",
      { class: "steps", "aria-label": "Steps" },
      ...lesson.steps.map((_, step) => element("li", { "data-done": done.has(step) }, link(step))),
    );
  }

  fold(): void {
    this.#text.isOpen = false;
  }

  #about(lesson: LessonEntry): HTMLElement {
    if (this.#text.lesson !== lesson.name) {
      const isNew = !this.#read().includes(lesson.name) && this.progress.done(lesson) === 0;
      this.#text = { lesson: lesson.name, isOpen: isNew };
    }
    const about = element(
      "details",
      { class: "about", open: this.#text.isOpen },
      element("summary", { "data-do": "about" }, "Explanation"),
      ...lesson.text.map(text => element("p", {}, ...prose(text))),
    );
    about.addEventListener("toggle", () => {
      this.#text.isOpen = about.open;
      if (!about.open) {
        remember(own(READ), [...new Set([...this.#read(), lesson.name])]);
      }
    });
    return about;
  }

  #read(): string[] {
    return recall<string[]>(own(READ)) ?? [];
  }

  /** The hints that were asked for, the button for another one, and that which says what is missing. */
  #hintElements(lesson: LessonEntry, shown: Shown): (HTMLElement | false)[] {
    const step = lesson.steps[shown.step];
    if (step === undefined || this.progress.steps(lesson).has(shown.step)) {
      return [];
    }
    const hints = step.hints.length > 0 ? step.hints : lesson.hints;
    const name = `${lesson.name} ${shown.step}`;
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
      element(
        "p",
        { class: "row" },
        count < hints.length && button(label, more, { class: "link", "data-do": "hint" }),
        button("What is missing?", () => this.doors.why(), { class: "link", "data-do": "why" }),
      ),
    ];
  }

  #buttons(lesson: LessonEntry, finished: boolean, shown: Shown): (HTMLElement | false)[] {
    const { next } = shown;
    const kept = keptPrograms(shown.folder, lesson.name);
    return [
      button("Back to the lesson’s program", () => this.doors.resume(lesson), {
        class: "resume",
        "data-do": "resume",
        title: `${lessonPath(lesson)} is what the lesson is about`,
      }),
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

function missingElement(missing: string[]): HTMLElement {
  return element(
    "ul",
    { class: "missing", role: "status", "aria-label": "Not yet", hidden: missing.length === 0 },
    ...missing.map(one => element("li", {}, `Not yet: ${one}.`)),
  );
}

export function stepElement(task: string, done: boolean): HTMLElement {
  return element(
    "li",
    { "data-done": done },
    element("span", { class: "box", role: "img", "aria-label": done ? "done" : "to do" }, done ? "✓" : ""),
    element("span", {}, ...prose(task)),
  );
}

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
