// How far one is in the lessons, and the smallest circuits so far, remembered by the browser.

import { own, recall, remember } from "../memory";
import type { LessonEntry } from "../protocol";
import { holds } from "./checks";
import type { Situation } from "./situation";

const NAME = "lessons";
const SIZES = "lesson-sizes";

export class Progress {
  /** The steps that are done by the name of the lesson, or how many of the first ones are. */
  readonly #done: Record<string, number[] | number>;
  readonly #sizes: Record<string, number>;

  constructor(
    stored: Record<string, number[] | number> | null = recall(own(NAME)),
    sizes: Record<string, number> | null = recall(own(SIZES)),
  ) {
    this.#done = { ...stored };
    this.#sizes = { ...sizes };
  }

  /** The steps of a lesson that are done, from 0. */
  steps(lesson: LessonEntry): Set<number> {
    const done = this.#done[lesson.name] ?? 0;
    const all = typeof done === "number" ? Array.from({ length: done }, (_, i) => i) : done;
    return new Set(all.filter(step => step < lesson.steps.length));
  }

  done(lesson: LessonEntry): number {
    return this.steps(lesson).size;
  }

  isFinished(lesson: LessonEntry): boolean {
    return this.done(lesson) === lesson.steps.length;
  }

  /** The first step from `from` on that is not done, or else any such step; the number of steps if all are done. */
  next(lesson: LessonEntry, from = 0): number {
    const done = this.steps(lesson);
    const open = [...lesson.steps.keys()].filter(step => !done.has(step));
    return open.find(step => step >= from) ?? open[0] ?? lesson.steps.length;
  }

  /** Checks a step; whether it is done now. */
  advance(lesson: LessonEntry, number: number, situation: Situation): boolean {
    const step = lesson.steps[number];
    const done = this.steps(lesson);
    if (step === undefined || done.has(number) || !step.checks.every(check => holds(check, situation, lesson))) {
      return false;
    }
    this.#set(lesson, [...done, number]);
    return true;
  }

  restart(lesson: LessonEntry): void {
    this.#set(lesson, []);
  }

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
    remember(own(SIZES), this.#sizes);
    return true;
  }

  #set(lesson: LessonEntry, steps: number[]): void {
    this.#done[lesson.name] = steps;
    remember(own(NAME), this.#done);
  }
}
