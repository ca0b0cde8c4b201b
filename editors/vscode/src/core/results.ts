// What `nbc test --format json` and `nbc prove --format json` print (docs/schema/), and what editors show of it.

import type { DecidedClaim, DecidedProperty, Finding, RowVerdict, TestVerdict } from "../../../../web/src/protocol";

/** A failed row or a property that is not proved, in words. */
export interface Failure {
  /** From 1. */
  line: number;
  message: string;
  /** Of a row only. */
  expected?: string;
  observed?: string;
}

const SCHEMA = "urn:nbc:test:1";
const CLAIM_SCHEMA = "urn:nbc:prove:1";

/** The results in the output of `nbc test --format json`; an error if it is something else. */
export function readResults(stdout: string): TestVerdict[] {
  return listed(stdout, SCHEMA, "tests") as TestVerdict[];
}

/** The results in the output of `nbc prove --format json`; an error if it is something else. */
export function readClaims(stdout: string): DecidedClaim[] {
  return listed(stdout, CLAIM_SCHEMA, "claims") as DecidedClaim[];
}

function listed(stdout: string, schema: string, name: string): unknown[] {
  const read = parsed(stdout);
  const list = read?.[name];
  if (read?.schema !== schema || !Array.isArray(list)) {
    throw new Error(`expected results in the format ${schema}, found ${excerpt(stdout)}`);
  }
  return list;
}

/** Why no test ran: the messages of the diagnostics, or what was printed as text. */
export function readFaults(stdout: string, stderr: string): string {
  const read = parsed(stdout);
  if (Array.isArray(read?.diagnostics) && read.diagnostics.length > 0) {
    return (read.diagnostics as Finding[]).map(describeDiagnostic).join("\n");
  }
  return stderr.trim() || excerpt(stdout);
}

function describeDiagnostic({ severity, message, help, labels }: Finding): string {
  const place = labels.slice(0, 1).map(({ file, start }) => `${file}:${start.line}:${start.column}: `);
  return `${place.join("")}${severity}: ${message}${help ? `; ${help}` : ""}`;
}

function parsed(text: string): Record<string, unknown> | undefined {
  try {
    const value: unknown = JSON.parse(text);
    return typeof value === "object" && value !== null ? (value as Record<string, unknown>) : undefined;
  } catch {
    return undefined;
  }
}

function excerpt(text: string): string {
  return text.trim() === "" ? "nothing" : `\`${text.trim().slice(0, 200)}\``;
}

export function unproved({ line = 0, verdict, how, test }: DecidedProperty): Failure {
  const words = verdict === "refuted" ? `refuted ${how}` : `undecided; ${how}`;
  return { line, message: test === undefined ? words : `${words}\n${test.trimEnd()}` };
}

export function failures(test: TestVerdict): Failure[] {
  return test.rows.filter(row => !row.passed).map(row => failure(test, row));
}

function failure(test: TestVerdict, row: RowVerdict): Failure {
  const swarm = test.swarm === null ? "" : `swarm ${test.swarm}, `;
  const ports = test.outputs
    .map(({ name }, at) => ({ name, at }))
    .filter(({ at }) => /[01]/.test(row.expected[at]!.bits));
  const values = (value: (at: number) => string) => ports.map(({ name, at }) => `${name} = ${value(at)}`).join("\n");
  return {
    line: row.line,
    message: swarm + (row.words ?? `row ${row.row} failed`),
    expected: values(at => row.expected[at]!.text),
    observed: values(at => (row.steady[at] ? row.observed[at]!.text : "keeps changing")),
  };
}
