// The results of a run, for each declared test and row.

import type { DeclaredTest } from "./declared";
import type { DecidedClaim, TestVerdict } from "../../../../web/src/protocol";
import { failures, type Failure, unproved } from "./results";

/** The result of a test or claim. Rows are in the order of their declarations. */
export interface Verdict {
  /** Without results, a test did not run. */
  state: "passed" | "failed" | "missing";
  /** The failures that belong to no row that is written, as in tests of all inputs. */
  failures: Failure[];
  rows: RowState[];
}

/** The result of a row in all swarms of its test, or of a property. */
export interface RowState {
  state: "passed" | "failed" | "missing";
  failures: Failure[];
}

const MOST_FAILURES = 20;

/** The verdict of a declared test: it passes if it does with every swarm of its circuit. */
export function verdictOf(test: DeclaredTest, results: TestVerdict[]): Verdict {
  const mine = results.filter(result => result.line === test.line + 1);
  const failed = mine.flatMap(failures);
  const rows = test.rows.map(({ line }) => {
    const seen = mine.some(result => result.rows.some(row => row.line === line + 1));
    return verdict(
      seen,
      failed.filter(failure => failure.line === line + 1),
    );
  });
  const written = new Set(test.rows.map(({ line }) => line + 1));
  const loose = failed.filter(failure => !written.has(failure.line));
  const state = mine.length === 0 ? "missing" : mine.every(result => result.passed) ? "passed" : "failed";
  return { state, failures: shortened(loose), rows };
}

/** The verdict of a declared claim: it passes if all its properties are proved. */
export function verdictOfClaim(claim: DeclaredTest, results: DecidedClaim[]): Verdict {
  const mine = results.filter(result => result.line === claim.line + 1).flatMap(({ properties }) => properties);
  const rows = claim.rows.map(({ line }) => {
    const own = mine.filter(property => property.line === line + 1);
    return verdict(own.length > 0, own.filter(({ verdict }) => verdict !== "proved").map(unproved));
  });
  const state = mine.length === 0 ? "missing" : mine.every(({ verdict }) => verdict === "proved") ? "passed" : "failed";
  return { state, failures: [], rows };
}

function verdict(seen: boolean, failures: Failure[]): RowState {
  return { state: !seen ? "missing" : failures.length === 0 ? "passed" : "failed", failures };
}

function shortened(failures: Failure[]): Failure[] {
  const more = failures.length - MOST_FAILURES;
  if (more <= 0) {
    return failures;
  }
  const shown = failures.slice(0, MOST_FAILURES);
  const last = shown[MOST_FAILURES - 1]!;
  const word = more === 1 ? "row" : "rows";
  return [...shown.slice(0, -1), { ...last, message: `${last.message}\n${more} more ${word} failed` }];
}
