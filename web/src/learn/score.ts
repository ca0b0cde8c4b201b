// How small a circuit is, next to the best one known.

import { counted } from "../counted";
import type { LessonEntry, LessonGoal } from "../protocol";
import { holds } from "./checks";
import type { Situation } from "./situation";

export const STARS = 3;

export function sizeOf(lesson: LessonEntry, situation: Situation): number | null {
  if (lesson.best === null || !isRight(lesson, situation)) {
    return null;
  }
  return lesson.best.of === "robots" ? situation.robots.length : situation.gates;
}

/** Whether all conditions of the lesson hold that are about the program alone. */
function isRight(lesson: LessonEntry, situation: Situation): boolean {
  const isAbout = (is: string): boolean => ["tests-pass", "tests-kept", "robots-only", "without"].includes(is);
  const checks = lesson.steps.flatMap(step => step.checks).filter(check => isAbout(check.is));
  return situation.robots.length > 0 && checks.every(check => holds(check, situation, lesson));
}

/** Three stars for the best size, two for half as much again, else one. */
export function starsOf(size: number, best: number): number {
  return size <= best ? STARS : size <= 1.5 * best ? 2 : 1;
}

/** A size in words. The compiler may build what is written of fewer robots, or of more. */
export function sizeText(size: number, of: LessonGoal["of"]): string {
  const text = counted(size, of.slice(0, -1));
  return of === "gates" ? `${text} in the text` : text;
}
