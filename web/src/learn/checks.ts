// The conditions of lessons.

import type { LessonCheck, LessonCount, LessonEntry, WrittenProgram } from "../protocol";
import type { Situation } from "./situation";

type Values = { [port: string]: number | undefined };

/** The last cycles in which `has-shown` looks. */
const LATELY = 400;

export function holds(check: LessonCheck, situation: Situation, lesson: LessonEntry): boolean {
  const { now, written, tests, passed, failed, claims, proved, refuted, search, design } = situation;
  switch (check.is) {
    case "shows":
      return has(situation, check.values, now);
    case "hides":
      return now > 0 && check.patterns.every(values => !has(situation, values, now));
    case "keeps":
      return (
        now - situation.hold >= 1 &&
        cycles(now - situation.hold, now).every(cycle => has(situation, check.values, cycle))
      );
    case "has-shown":
      return check.patterns.every(values => wasShown(situation, values));
    case "designs":
      return (
        design.probe !== null && !("fault" in design.probe) && (design.probe.function === check.gate) !== check.except
      );
    case "counts":
      return compares(counted(check.what, situation), check.than, check.number);
    case "robots-only":
      return situation.robots.length > 0 && situation.robots.every(gate => check.gates.includes(gate));
    case "without":
      return written !== null && !check.words.some(word => written.words.includes(word));
    case "circuit":
      return situation.circuit === check.name;
    case "tests-pass":
      return tests > 0 && passed === tests;
    case "tests-fail":
      return failed > 0;
    case "passes":
      return situation.hidden.get(check.test) === null;
    case "claims-proved":
      return claims > 0 && proved === claims;
    case "claims-refuted":
      return refuted > 0;
    case "tests-kept":
      return written !== null && lostLine(written, lesson) === undefined;
    case "program-changed":
      return (
        situation.isChecked &&
        situation.errors === 0 &&
        situation.circuits > 0 &&
        tests > 0 &&
        written?.text !== lesson.written?.text
      );
    case "outputs-lit":
      return situation.outputs.some(name => (situation.port(name, now) ?? 0) > 0);
    case "evolving":
      return search.running;
    case "niche-chosen":
      return search.chosen !== null && search.chosen.body.join() === design.body.join();
  }
}

/** A line of the lesson's tests and claims that a program does not have. */
export function lostLine(written: WrittenProgram, lesson: LessonEntry): string | undefined {
  return lesson.written?.kept.find(line => !written.kept.includes(line));
}

export function wasShown(situation: Situation, values: Values): boolean {
  const { now } = situation;
  return cycles(Math.max(1, now - LATELY), now).some(cycle => has(situation, values, cycle));
}

function has(situation: Situation, values: Values, cycle: number): boolean {
  return Object.entries(values).every(([name, value]) => situation.port(name, cycle) === value);
}

function cycles(first: number, last: number): number[] {
  return Array.from({ length: last - first + 1 }, (_, i) => first + i);
}

function counted(what: LessonCount, { robots, now, search, threads }: Situation): number {
  return { robots: robots.length, cycles: now, niches: search.niches.length, threads }[what];
}

function compares(found: number, than: "<=" | ">=" | "=", number: number): boolean {
  return than === "<=" ? found <= number : than === ">=" ? found >= number : found === number;
}
