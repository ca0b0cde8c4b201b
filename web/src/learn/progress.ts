// How far one is in the lessons, and the smallest circuits so far, remembered by the browser.

import { recall, remember } from "../memory";
import type { LessonEntry } from "../protocol";
import { holds } from "./checks";
import type { Situation } from "./situation";

const NAME = "lessons";
const SIZES = "lesson-sizes";

export class Progress {
  /** The number of steps done by the name of the lesson. */
  readonly #done: Record<string, number>;
  /** The size of the smallest circuit that was right. */
  readonly #sizes: Record<string, number>;

  constructor(
    stored: Record<string, number> | null = recall(NAME),
    sizes: Record<string, number> | null = recall(SIZES),
  ) {
    this.#done = { ...stored };
    this.#sizes = { ...sizes };
  }

  done(lesson: LessonEntry): number {
    return Math.min(lesson.steps.length, this.#done[lesson.name] ?? 0);
  }

  isFinished(lesson: LessonEntry): boolean {
    return this.done(lesson) === lesson.steps.length;
  }

  /** Checks the next step; whether it is done now. */
  advance(lesson: LessonEntry, situation: Situation): boolean {
    const step = lesson.steps[this.done(lesson)];
    if (step === undefined || !step.checks.every(check => holds(check, situation, lesson))) {
      return false;
    }
    this.#set(lesson, this.done(lesson) + 1);
    return true;
  }

  restart(lesson: LessonEntry): void {
    this.#set(lesson, 0);
  }

  /** The size of the smallest circuit of a lesson; null if there is none. */
  size(lesson: LessonEntry): number | null {
    return this.#sizes[lesson.name] ?? null;
  }

  /** Notes the size of a circuit that is right; whether it is the smallest so far. */
  noteSize(lesson: LessonEntry, size: number): boolean {
    const before = this.size(lesson);
    if (before !== null && before <= size) {
      return false;
    }
    this.#sizes[lesson.name] = size;
    remember(SIZES, this.#sizes);
    return true;
  }

  #set(lesson: LessonEntry, steps: number): void {
    this.#done[lesson.name] = steps;
    remember(NAME, this.#done);
  }
}
