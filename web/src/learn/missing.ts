// What a step of a lesson still needs, and why it does not count yet, in words.

import { counted } from "../counted";
import type { LessonCheck, LessonEntry } from "../protocol";
import { holds, lostLine, wasShown } from "./checks";
import type { Situation } from "./situation";

type Values = { [port: string]: number | undefined };

/** Conditions that may hold before anything is done. */
const AT_FIRST = ["tests-kept", "without", "robots-only", "circuit", "hides", "counts"];

/**
 * What the step of that number still needs, once a learner has done a part of it or run a test, or asks for it. Before
 * that its task says enough.
 */
export function missing(lesson: LessonEntry, step: number, situation: Situation, isAsked = false): string[] {
  const checks = lesson.steps[step]?.checks ?? [];
  const open = checks.filter(check => !holds(check, situation, lesson));
  const isBegun = checks.some(check => !AT_FIRST.includes(check.is) && !open.includes(check));
  const { problem } = situation;
  if (open.length === 0 || !(isAsked || isBegun || problem !== null || situation.passed + situation.failed > 0)) {
    return [];
  }
  const wanted = open.map(check => joined(wordsOf(check), reason(check, situation, lesson)));
  return problem === null ? wanted : [`first, the error in the program: ${problem}`, ...wanted];
}

function joined(wanted: string, why: string): string {
  return why === "" ? wanted : `${wanted} – ${why}`;
}

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
      return `the circuits are written without ${quoted(check.words)}`;
    case "circuit":
      return `the circuit ${check.name} is chosen`;
    case "tests-pass":
      return "all tests have been run and pass";
    case "tests-fail":
      return "a test has been run and fails";
    case "passes":
      return "the circuit does what is asked in all cases";
    case "claims-proved":
      return "all that is claimed is proved";
    case "claims-refuted":
      return "a property is refuted";
    case "tests-kept":
      return "every line of the lesson’s tests and claims is still there";
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

/** Why a condition does not hold; empty where there is no more to say. */
function reason(check: LessonCheck, situation: Situation, lesson: LessonEntry): string {
  const { now, written, tests, passed, failed, design } = situation;
  switch (check.is) {
    case "shows":
    case "keeps":
      return shownText(check.values, situation);
    case "has-shown":
      return `not yet ${check.patterns
        .filter(values => !wasShown(situation, values))
        .map(valuesText)
        .join("; ")}`;
    case "designs":
      if (design.probe === null) {
        return "it is being simulated";
      }
      return "fault" in design.probe ? design.probe.fault : `it is ${design.probe.function ?? "no gate"}`;
    case "counts":
      return { robots: `it has ${situation.robots.length}`, cycles: `${now} so far` }[check.what as string] ?? "";
    case "robots-only": {
      const others = [...new Set(situation.robots.filter(gate => !check.gates.includes(gate)))];
      return others.length === 0 ? notCompiled(situation) : `there is also ${others.join(", ")}`;
    }
    case "without":
      return thereText(check.words.filter(word => written?.words.includes(word)));
    case "circuit":
      return situation.circuit === null ? notCompiled(situation) : `${situation.circuit} is`;
    case "tests-pass":
      return tests === 0 ? notCompiled(situation) || "there is none" : testsText(tests, passed, failed);
    case "tests-fail":
      return passed === 0 ? "none has been run" : "those that were run pass";
    case "passes":
      return situation.hidden.get(check.test) ?? "";
    case "claims-proved":
      if (situation.claims === 0) {
        return notCompiled(situation) || "nothing is claimed";
      }
      return situation.refuted > 0 ? "a property is refuted" : "it has not been decided";
    case "claims-refuted":
      return situation.proved > 0 ? "all that was decided is proved" : "nothing has been decided";
    case "tests-kept":
      return written === null ? notCompiled(situation) : `missing: ${lostLine(written, lesson) ?? ""}`;
    case "program-changed":
      return written?.text === lesson.written?.text ? "it is still that of the lesson" : notCompiled(situation);
    default:
      return "";
  }
}

/** Words of a program, so that nobody reads them as words of the sentence. */
function quoted(words: string[]): string {
  return words.map(word => (word === "calls" ? "calls of standard circuits" : `\`${word}\``)).join(", ");
}

function thereText(words: string[]): string {
  return `${quoted(words)} ${words.length > 1 || words.includes("calls") ? "are" : "is"} there`;
}

function notCompiled({ isChecked, errors, circuits }: Situation): string {
  if (!isChecked) {
    return "the program is being checked";
  }
  return errors > 0 ? `the program has ${counted(errors, "error")}` : circuits === 0 ? "there is no circuit" : "";
}

function testsText(tests: number, passed: number, failed: number): string {
  const run = passed + failed;
  return failed > 0
    ? `${failed} of ${tests} fail`
    : run === 0
      ? "none has been run"
      : `${run} of ${tests} have been run`;
}

function shownText(values: Values, { now, port }: Situation): string {
  const wrong = Object.entries(values).filter(([name, value]) => port(name, now) !== value);
  if (wrong.length === 0) {
    return "not for long enough yet";
  }
  const text = ([name]: [string, unknown]): string => {
    const shown = port(name, now);
    return shown === null ? `there is no ${name}` : `${name} = ${shown}`;
  };
  return now === 0 ? "it has not run yet" : `now ${wrong.map(text).join(", ")}`;
}

function valuesText(values: Values): string {
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
