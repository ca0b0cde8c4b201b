// Results of `nbc test --format json`: verdicts of declared tests and rows, and their messages.

import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import * as path from "node:path";
import { test } from "node:test";

import { declaredTests } from "../src/core/declared";
import type { TestVerdict } from "../../../web/src/protocol";
import { failures, readFaults, readResults } from "../src/core/results";
import { verdictOf } from "../src/core/verdicts";
import { NBC } from "./nbc";

const FAULTY = `circuit g(a, b) -> (q) { q = a nand b }
test g "rows" {
    a b | q
    0 0 | 0
    1 1 | 0
}
test g "all" for all inputs { q = a and b }
swarm x { circuit: g }
swarm y { circuit: g, hold: 3 cycles }
circuit ring() -> (q) { q init 0 = not q }
test ring {
    | q
    | 1 for 9 cycles
    | - for 9 cycles
}
`;

/** What `nbc test` prints for a program. */
function tested(source: string, ...args: string[]): Promise<{ stdout: string; stderr: string }> {
  const folder = mkdtempSync(path.join(tmpdir(), "nbc-editor-"));
  const file = path.join(folder, "a.nb");
  writeFileSync(file, source);
  return new Promise(resolve =>
    execFile(NBC, ["test", "--format", "json", ...args, "a.nb"], { cwd: folder }, (_, stdout, stderr) => {
      rmSync(folder, { recursive: true });
      resolve({ stdout, stderr });
    }),
  );
}

test("a test passes if it does with every swarm, and a row shows what was expected and observed", async () => {
  const results = readResults((await tested(FAULTY)).stdout);
  const [rows, all, ring] = declaredTests(FAULTY).map(declared => verdictOf(declared, results));
  assert.equal(rows!.state, "failed");
  assert.deepEqual(
    rows!.rows.map(row => row.state),
    ["failed", "passed"],
  );
  const words =
    "row 1: a=0 b=0 | q=1, expected 0\nnearest fix: every robot computed its gate, so correct the circuit or the test";
  const compared = { expected: "q = 0", observed: "q = 1" };
  assert.deepEqual(
    rows!.rows[0]!.failures,
    ["x", "y"].map(swarm => ({ line: 4, message: `swarm ${swarm}, ${words}`, ...compared })),
  );
  assert.deepEqual(rows!.failures, []);
  assert.equal(all!.state, "failed");
  assert.equal(all!.failures.length, 8);
  assert.deepEqual(
    ring!.rows.map(row => row.state),
    ["failed", "passed"],
  );
  assert.match(ring!.rows[0]!.failures[0]!.message, /^row 1: q keeps changing, expected 1$/m);
  assert.equal(ring!.rows[0]!.failures[0]!.observed, "q = keeps changing");
});

test("a test of which nothing was reported did not run", () => {
  const [declared] = declaredTests(FAULTY);
  const verdict = verdictOf(declared!, []);
  assert.equal(verdict.state, "missing");
  assert.deepEqual(
    verdict.rows.map(row => row.state),
    ["missing", "missing"],
  );
});

test("faults of the program are its diagnostics, with their places", async () => {
  const { stdout, stderr } = await tested(FAULTY.replace("a nand b }", "a nand bb }"));
  assert.throws(() => readResults(stdout), /expected results in the format urn:nbc:test:1/);
  const faults = readFaults(stdout, stderr);
  assert.match(faults, /^a\.nb:1:37: error: no net is called `bb`; did you mean `b`\?/);
});

test("output that is something else is quoted", () => {
  assert.throws(() => readResults("thread panicked"), /found `thread panicked`/);
  assert.throws(() => readResults('{"schema":"urn:nbc:test:2","tests":[]}'), /found `\{"schema"/);
  assert.equal(readFaults("", "no such option"), "no such option");
  assert.equal(readFaults("", ""), "nothing");
});

test("values that are not checked are not shown, and an older program has no words", () => {
  const value = (text: string) => ({ text, bits: text });
  const row = {
    row: 2,
    line: 9,
    inputs: [value("1")],
    expected: [value("1"), value("-")],
    observed: [value("0"), value("1")],
    steady: [true, false],
    passed: false,
  };
  const result = { inputs: [{ name: "d" }], outputs: [{ name: "q" }, { name: "r" }], swarm: null, rows: [row] };
  const failure = { line: 9, message: "row 2 failed", expected: "q = 1", observed: "q = 0" };
  assert.deepEqual(failures(result as unknown as TestVerdict), [failure]);
});

test("a test of very many inputs shows some of its failures", () => {
  const [, declared] = declaredTests(FAULTY);
  const value = { text: "1", bits: "1" };
  const rows = Array.from({ length: 64 }, (_, row) => ({
    ...{ row: row + 1, line: 7, inputs: [], expected: [value], observed: [{ text: "0", bits: "0" }], steady: [true] },
    ...{ cycles: null, needed: null, passed: false, lapses: [], late: [] },
  }));
  const result = { line: 7, passed: false, inputs: [], outputs: [{ name: "q" }], swarm: null, rows };
  const { failures } = verdictOf(declared!, [result as unknown as TestVerdict]);
  assert.equal(failures.length, 20);
  assert.match(failures.at(-1)!.message, /44 more rows failed$/);
});
