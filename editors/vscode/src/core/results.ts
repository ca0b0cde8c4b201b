// What `nbc test --format json` and `nbc prove --format json` print (docs/schema/), and what editors show of it.

import type {
  DecidedClaim,
  DecidedProperty,
  Finding,
  RowVerdict,
  TestVerdict,
  Value,
  WrongOutput,
} from "../../../../web/src/protocol";

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
  const read = parsed(stdout);
  if (read?.schema !== SCHEMA || !Array.isArray(read.tests)) {
    throw new Error(`expected results in the format ${SCHEMA}, found ${excerpt(stdout)}`);
  }
  return read.tests as TestVerdict[];
}

/** The results in the output of `nbc prove --format json`; an error if it is something else. */
export function readClaims(stdout: string): DecidedClaim[] {
  const read = parsed(stdout);
  if (read?.schema !== CLAIM_SCHEMA || !Array.isArray(read.claims)) {
    throw new Error(`expected results in the format ${CLAIM_SCHEMA}, found ${excerpt(stdout)}`);
  }
  return read.claims as DecidedClaim[];
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
  const checked = test.outputs
    .map((port, at) => ({ port, expected: row.expected[at]!, observed: row.observed[at]!, steady: row.steady[at]! }))
    .filter(({ expected }) => /[01]/.test(expected.bits));
  const wrong = checked.filter(({ expected, observed, steady }) => !steady || differs(expected, observed));
  const state = ({ observed, steady }: { observed: Value; steady: boolean }) =>
    steady ? observed.text : "keeps changing";
  const complaint = (output: (typeof checked)[number]) =>
    output.steady
      ? `${output.port.name}=${output.observed.text}, expected ${output.expected.text}`
      : `${output.port.name} keeps changing, expected ${output.expected.text}`;
  const inputs = test.inputs.map((port, at) => `${port.name}=${row.inputs[at]!.text}`).join(" ");
  const head = `row ${row.row}${test.swarm === null ? "" : ` as ${test.swarm}`}: ${inputs}${inputs && " | "}`;
  return {
    line: row.line,
    message: [head + wrong.map(complaint).join("; "), ...blame(row)].join("\n"),
    expected: checked.map(({ port, expected }) => `${port.name} = ${expected.text}`).join("\n"),
    observed: checked.map(output => `${output.port.name} = ${state(output)}`).join("\n"),
  };
}

function differs(expected: Value, observed: Value): boolean {
  return [...expected.bits].some((bit, at) => bit !== "-" && bit !== observed.bits[at]);
}

function blame(row: RowVerdict): string[] {
  const wrong = row.lapses.map(lapse => describeLapse(lapse, "output"));
  const late = row.late.map(lapse => describeLapse(lapse, "had not settled yet and output"));
  const short = row.cycles !== null && row.needed !== null && row.cycles < row.needed;
  const hold = short && row.lapses.length === 0 ? [`the row is held for ${row.cycles} of ${row.needed} cycles`] : [];
  return [...wrong, ...late, ...hold];
}

function describeLapse({ net, robot, cycle, sensed, output }: WrongOutput, did: string): string {
  const stimuli = sensed.map(Number).join(" ");
  return `cycle ${cycle + 1}: robot ${robot} on net ${net} ${did} ${Number(output)} on stimuli ${stimuli}`;
}
