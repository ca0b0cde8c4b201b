// What `nbc test --format json` and `nbc prove --format json` print (docs/schema/), and what editors show of it.

interface Port {
  name: string;
  width: number;
}

/** A value of a row: as users write it, and as bits, in which `-` is not checked. */
interface Value {
  text: string;
  bits: string;
}

interface Lapse {
  net: string;
  robot: string;
  /** From 0 at the start. */
  cycle: number;
  sensed: [boolean, boolean];
  output: boolean;
}

/** A row of a test that ran. Lines count from 1. */
export interface RowResult {
  row: number;
  line: number;
  inputs: Value[];
  expected: Value[];
  observed: Value[];
  steady: boolean[];
  cycles: number | null;
  needed: number | null;
  passed: boolean;
  lapses: Lapse[];
  late: Lapse[];
}

/** A test that ran with one swarm, or at the level of logic. */
export interface TestResult {
  file: string;
  line: number;
  circuit: string;
  title: string;
  swarm: string | null;
  level: "logic" | "physics";
  passed: boolean;
  inputs: Port[];
  outputs: Port[];
  rows: RowResult[];
  /** How a test for ever was decided, in words. */
  proof?: string;
}

/** Lines count from 1. */
export interface PropertyResult {
  property: string;
  line: number;
  verdict: "proved" | "refuted" | "undecided";
  /** Steps of the run that violates it, or the first steps in which it holds. */
  steps: number;
  /** A test whose last row violates it. */
  test?: string;
}

export interface ClaimResult {
  line: number;
  properties: PropertyResult[];
}

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
export function readResults(stdout: string): TestResult[] {
  const read = parsed(stdout);
  if (read?.schema !== SCHEMA || !Array.isArray(read.tests)) {
    throw new Error(`expected results in the format ${SCHEMA}, found ${excerpt(stdout)}`);
  }
  return read.tests as TestResult[];
}

/** The results in the output of `nbc prove --format json`; an error if it is something else. */
export function readClaims(stdout: string): ClaimResult[] {
  const read = parsed(stdout);
  if (read?.schema !== CLAIM_SCHEMA || !Array.isArray(read.claims)) {
    throw new Error(`expected results in the format ${CLAIM_SCHEMA}, found ${excerpt(stdout)}`);
  }
  return read.claims as ClaimResult[];
}

/** Why no test ran: the messages of the diagnostics, or what was printed as text. */
export function readFaults(stdout: string, stderr: string): string {
  const read = parsed(stdout);
  if (Array.isArray(read?.diagnostics) && read.diagnostics.length > 0) {
    return (read.diagnostics as Diagnostic[]).map(describeDiagnostic).join("\n");
  }
  return stderr.trim() || excerpt(stdout);
}

interface Diagnostic {
  severity: string;
  message: string;
  help: string | null;
  labels: { file: string; start: { line: number; column: number } }[];
}

function describeDiagnostic({ severity, message, help, labels }: Diagnostic): string {
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

export function unproved({ line, verdict, steps, test }: PropertyResult): Failure {
  const word = steps === 1 ? "step" : "steps";
  const how =
    verdict === "refuted" ? `refuted after ${steps} ${word}` : `undecided; it holds in the first ${steps} ${word}`;
  return { line, message: test === undefined ? how : `${how}\n${test.trimEnd()}` };
}

export function failures(test: TestResult): Failure[] {
  return test.rows.filter(row => !row.passed).map(row => failure(test, row));
}

function failure(test: TestResult, row: RowResult): Failure {
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

function blame(row: RowResult): string[] {
  const wrong = row.lapses.map(lapse => describeLapse(lapse, "output"));
  const late = row.late.map(lapse => describeLapse(lapse, "had not settled yet and output"));
  const short = row.cycles !== null && row.needed !== null && row.cycles < row.needed;
  const hold = short && row.lapses.length === 0 ? [`the row is held for ${row.cycles} of ${row.needed} cycles`] : [];
  return [...wrong, ...late, ...hold];
}

function describeLapse({ net, robot, cycle, sensed, output }: Lapse, did: string): string {
  const stimuli = sensed.map(Number).join(" ");
  return `cycle ${cycle + 1}: robot ${robot} on net ${net} ${did} ${Number(output)} on stimuli ${stimuli}`;
}
