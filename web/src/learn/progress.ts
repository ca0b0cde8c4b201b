// How far one is in the lessons, remembered by the browser.

import { recall, remember } from "../memory";
import { LESSONS, type Lesson } from "./lessons";
import type { Situation } from "./situation";

const NAME = "lessons";

export class Progress {
  /** The number of steps done by the name of the lesson. */
  readonly #done: Record<string, number>;

  constructor(stored: Record<string, number> | null = recall(NAME)) {
    this.#done = { ...stored };
  }

  done(lesson: Lesson): number {
    return Math.min(lesson.steps.length, this.#done[lesson.name] ?? 0);
  }

  isFinished(lesson: Lesson): boolean {
    return this.done(lesson) === lesson.steps.length;
  }

  /** Checks the next step; whether it is done now. */
  advance(lesson: Lesson, situation: Situation): boolean {
    const step = lesson.steps[this.done(lesson)];
    if (step === undefined || !step.check(situation)) {
      return false;
    }
    this.#set(lesson, this.done(lesson) + 1);
    return true;
  }

  restart(lesson: Lesson): void {
    this.#set(lesson, 0);
  }

  /** The first lesson that is not finished. */
  next(): Lesson | null {
    return LESSONS.find(lesson => !this.isFinished(lesson)) ?? null;
  }

  #set(lesson: Lesson, steps: number): void {
    this.#done[lesson.name] = steps;
    remember(NAME, this.#done);
  }
}
