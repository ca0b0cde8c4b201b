// What a step of a lesson still needs, in words.

import { counted } from "../counted";
import type { LessonCheck, LessonEntry } from "../protocol";
import { holds } from "./checks";
import type { Situation } from "./situation";

/** Conditions of the text, which may hold before anything is done. */
const OF_TEXT = ["tests-kept", "without", "robots-only"];

/**
 * What the step of that number still needs, once a learner has done a part of it or run a test. Before that its task
 * says enough.
 */
export function missing(lesson: LessonEntry, step: number, situation: Situation): string[] {
  const checks = lesson.steps[step]?.checks ?? [];
  const open = checks.filter(check => !holds(check, situation, lesson));
  const isBegun = checks.some(check => !OF_TEXT.includes(check.is) && !open.includes(check));
  return isBegun || situation.passed + situation.failed > 0 ? open.map(check => wordsOf(check)) : [];
}

/** What a condition asks for. */
export function wordsOf(check: LessonCheck): string {
  switch (check.is) {
    case "shows":
      return `the swarm shows ${valuesText(check.values)}`;
    case "keeps":
      return `the swarm keeps ${valuesText(check.values)} until it has settled`;
    case "hides":
      return `the swarm no longer shows ${check.patterns.map(valuesText).join(" or ")}`;
    case "has-shown":
      return `the swarm has shown each of ${check.patterns.map(valuesText).join("; ")}`;
    case "designs":
      return check.except ? `the body is another gate than ${check.gate}` : `the body is a gate: ${check.gate}`;
    case "counts":
      return countText(check);
    case "robots-only":
      return `all robots of the circuit are ${check.gates.join(" or ")}`;
    case "without":
      return `the circuits are written without ${check.words.join(", ")}`;
    case "circuit":
      return `the circuit ${check.name} is chosen`;
    case "tests-pass":
      return "all tests have been run and pass";
    case "tests-fail":
      return "a test has been run and fails";
    case "tests-kept":
      return "every line of the lesson’s tests is still there";
    case "program-changed":
      return "the program is another one, without errors, with a circuit and a test";
    case "outputs-lit":
      return "an output is 1";
    case "evolving":
      return "the evolution runs";
    case "niche-chosen":
      return "a square of the evolution is in the designer";
  }
}

function valuesText(values: { [port: string]: number | undefined }): string {
  return Object.entries(values)
    .map(([name, value]) => `${name} = ${value}`)
    .join(", ");
}

function countText({ what, than, number }: Extract<LessonCheck, { is: "counts" }>): string {
  const limit = { "<=": "at most", ">=": "at least", "=": "exactly" }[than];
  const amount = (noun: string): string => `${limit} ${counted(number, noun)}`;
  return {
    robots: `the circuit has ${amount("robot")}`,
    cycles: `${amount("cycle")} ${number === 1 ? "has" : "have"} passed`,
    niches: `the evolution has found ${amount("kind")}`,
    threads: `the wave machine has ${amount("thread")}`,
  }[what];
}
