// The lessons, which the server has (docs/lessons.md).

import type { Connection } from "../connection";
import { Observable } from "../observable";
import type { Finding, LessonEntry } from "../protocol";
import { RequestError } from "../request";

export class Lessons {
  readonly list = new Observable<LessonEntry[]>([]);
  findings: Finding[] = [];

  constructor(private readonly connection: Connection) {}

  async load(): Promise<void> {
    try {
      const { lessons, findings } = await this.connection.request("lessons", {});
      this.findings = findings;
      this.list.set(lessons);
    } catch (error) {
      if (!(error instanceof RequestError)) {
        throw error;
      }
    }
  }

  named(name: string | null): LessonEntry | null {
    return this.list.value.find(lesson => lesson.name === name) ?? null;
  }

  after(lesson: LessonEntry): LessonEntry | null {
    const index = this.list.value.findIndex(({ name }) => name === lesson.name);
    return this.list.value[index + 1] ?? null;
  }
}

/** Where a lesson's program is, until it is saved elsewhere. */
export function lessonPath(lesson: LessonEntry): string {
  return `lesson_${lesson.name}.nb`;
}

/** Whether a lesson's program is at a path: its own, or that of a learner of a class, who is named before the ending. */
export function isLessonPath(lesson: LessonEntry, path: string): boolean {
  const own = lessonPath(lesson);
  const start = own.replace(/nb$/, "");
  return path === own || (path.startsWith(start) && /^[^./]+\.nb$/.test(path.slice(start.length)));
}

export function stepAddress(lesson: LessonEntry, step: number): string {
  return `lesson/${lesson.name}/${step + 1}`;
}

/** The lesson and the step of an address such as `lesson/latch/2`; null if it is none. */
export function lessonAddress(fragment: string): { name: string; step: number } | null {
  const [, name, step] = /^lesson\/([\w-]+)(?:\/(\d{1,3}))?$/.exec(fragment) ?? [];
  return name === undefined ? null : { name, step: Math.max(1, Number(step ?? 1)) - 1 };
}
