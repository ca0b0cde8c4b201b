// The tests that a program declares: as `nbc` reports them, and of texts that are being typed.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { test } from "node:test";

import { declaredTests } from "../src/core/declared";
import { readClaims, readResults } from "../src/core/results";
import { GALLERY, NBC } from "./nbc";

test("the gallery's tests and rows are where nbc reports them", () => {
  let rows = 0;
  for (const file of GALLERY) {
    const results = readResults(
      execFileSync(NBC, ["test", "--logic", "--format", "json", file], {
        encoding: "utf8",
        stdio: ["ignore", "pipe", "ignore"],
      }),
    );
    const declared = declaredTests(readFileSync(file, "utf8")).filter(({ kind }) => kind === "test");
    const heads = declared.map(({ circuit, title, line }) => [circuit.replace(/\[.*/, ""), title, line + 1]);
    const found = results.map(({ circuit, title, line }) => [circuit.replace(/\[.*/, ""), title, line]);
    assert.deepEqual(heads, [...new Map(found.map(one => [String(one), one])).values()], file);
    for (const [at, { rows: written }] of declared.entries()) {
      if (written.length > 0) {
        assert.deepEqual(
          written.map(row => row.line + 1),
          // A row with a rising edge is applied twice.
          [...new Set(results.find(result => result.line === declared[at]!.line + 1)!.rows.map(row => row.line))],
          file,
        );
        rows += written.length;
      }
    }
  }
  assert.ok(rows > 100, `${rows} rows were compared`);
});

test("the gallery's claims and properties are where nbc reports them", () => {
  let properties = 0;
  for (const file of GALLERY) {
    const declared = declaredTests(readFileSync(file, "utf8")).filter(({ kind }) => kind === "prove");
    if (declared.length === 0) {
      continue;
    }
    const printed = execFileSync(NBC, ["prove", "--format", "json", file], { encoding: "utf8" });
    const found = readClaims(printed).map(claim => [claim.line, claim.properties.map(({ line }) => line)]);
    assert.deepEqual(
      declared.map(({ line, rows }) => [line + 1, rows.map(row => row.line + 1)]),
      found,
      file,
    );
    properties += declared.flatMap(({ rows }) => rows).length;
  }
  assert.ok(properties > 20, `${properties} properties were compared`);
});

test("each form of a test is read", () => {
  const source = `//! test no "comment" { a | b
circuit test_me(a) -> (q) { q = a } // test neither {
test test_me "a { title" { // columns next
    a   | q // the header

    0   | 0 for 3 cycles
    ^   | 4'd1   // "a comment"
}
test ripple[n = 3] for all inputs {
    wide = {1'd0, a}
}
test mine "x" for all inputs against other[2]
test ring { | q
  | - for 30 cycles
}
test core "runs" with memory in [paper, worn] {
    a | q
    repeat 3 {
        0 | 1
        repeat 2 { 1 | 0 }
    }
    0 | - until q, at most 9 rows
}
test core in worn { a | q
    1 | 0 }
test read "held-out" from "a.csv" at least 92.5%
test read in [paper] from "b.csv"
test a "last" for all inputs {
}
test mine "y" against other[2] for ever
prove mine[3] "z" with memory {
    assume not a  // never
    always a and
        b => q within 8 steps
    never  q == 3
}
prove mine with memory
`;
  const tests = [
    {
      circuit: "test_me",
      title: "a { title",
      line: 2,
      endLine: 7,
      rows: [
        { line: 5, text: "0 | 0 for 3 cycles" },
        { line: 6, text: "^ | 4'd1" },
      ],
    },
    { circuit: "ripple[n = 3]", title: "", line: 8, endLine: 10, rows: [] },
    { circuit: "mine", title: "x", line: 11, endLine: 11, rows: [] },
    { circuit: "ring", title: "", line: 12, endLine: 14, rows: [{ line: 13, text: "| - for 30 cycles" }] },
    {
      circuit: "core",
      title: "runs",
      line: 15,
      endLine: 22,
      rows: [
        { line: 18, text: "0 | 1" },
        { line: 19, text: "1 | 0" },
        { line: 21, text: "0 | - until q, at most 9 rows" },
      ],
    },
    { circuit: "core", title: "", line: 23, endLine: 24, rows: [{ line: 24, text: "1 | 0" }] },
    { circuit: "read", title: "held-out", line: 25, endLine: 25, rows: [] },
    { circuit: "read", title: "", line: 26, endLine: 26, rows: [] },
    { circuit: "a", title: "last", line: 27, endLine: 28, rows: [] },
    { circuit: "mine", title: "y", line: 29, endLine: 29, rows: [] },
  ];
  const claim = {
    kind: "prove",
    circuit: "mine[3]",
    title: "z",
    line: 30,
    endLine: 35,
    rows: [
      { line: 32, text: "always a and b => q within 8 steps" },
      { line: 34, text: "never q == 3" },
    ],
  };
  assert.deepEqual(declaredTests(source), [...tests.map(test => ({ kind: "test", ...test })), claim]);
});

test("texts that are being typed have the tests that are complete so far", () => {
  const whole = 'test a "t" {\n x | q\n 0 | 1\n}\ntest b[2] for all inputs against c\n';
  for (let end = 0; end <= whole.length; end++) {
    const tests = declaredTests(whole.slice(0, end));
    assert.ok(tests.length <= 2 && (end < 15 || tests.length >= 1), whole.slice(0, end));
  }
  assert.deepEqual(
    declaredTests('test "x" {\n}\n}}}\ntest\ntest a { q\n').map(({ circuit }) => circuit),
    ["a"],
  );
});
