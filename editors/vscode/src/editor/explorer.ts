// The test explorer: runs `nbc test` and `nbc prove` on saved files, and shows their results at the items.

import * as vscode from "vscode";

import { run as runProgram } from "../core/child";
import { type DeclaredTest, nameOf } from "../core/declared";
import type { DecidedClaim, TestVerdict } from "../../../../web/src/protocol";
import { type Failure, readClaims, readFaults, readResults } from "../core/results";
import { verdictOf, verdictOfClaim } from "../core/verdicts";
import { folderOf, save } from "./files";
import { Items } from "./items";
import type { Program } from "./program";

/** The level at which tests run; `auto` leaves the choice to `nbc`. */
export type Level = "auto" | "physics" | "logic";

/** A command of `nbc`, with what it is to choose of a file. */
type Choice = [DeclaredTest["kind"], ...string[]];

interface Results {
  tests: TestVerdict[];
  claims: DecidedClaim[];
}

type Chosen = Map<vscode.TestItem, Set<vscode.TestItem>>;

export class Explorer implements vscode.Disposable {
  private readonly controller = vscode.tests.createTestController("nbc", "nbc");
  readonly items = new Items(this.controller);

  constructor(
    private readonly program: Program,
    private readonly log: vscode.LogOutputChannel,
  ) {
    this.profile("Run", () => vscode.workspace.getConfiguration("nbc").get<Level>("tests.level", "auto"), true);
    this.profile("Run as Logic", () => "logic");
    this.profile("Run in Physics", () => "physics");
  }

  dispose(): void {
    this.items.dispose();
    this.controller.dispose();
  }

  private profile(name: string, level: () => Level, isDefault = false): void {
    const kind = vscode.TestRunProfileKind.Run;
    const handler = (request: vscode.TestRunRequest, token: vscode.CancellationToken) =>
      request.continuous ? this.follow(request, token, level) : this.run(request, level());
    this.controller.createRunProfile(name, kind, handler, isDefault, undefined, true);
  }

  private follow(request: vscode.TestRunRequest, token: vscode.CancellationToken, level: () => Level): void {
    const saves = vscode.workspace.onDidSaveTextDocument(document => {
      const files = [...this.chosen(request)].filter(([file]) => file.id === document.uri.toString());
      const tests = files.flatMap(([, tests]) => [...tests]);
      if (tests.length > 0) {
        void this.run(new vscode.TestRunRequest(tests, undefined, request.profile, true), level());
      }
    });
    token.onCancellationRequested(() => saves.dispose());
  }

  private async run(request: vscode.TestRunRequest, level: Level): Promise<void> {
    const run = this.controller.createTestRun(request);
    const chosen = this.chosen(request);
    chosen.forEach(tests => tests.forEach(test => withRows(test).forEach(item => run.enqueued(item))));
    try {
      for (const [file, tests] of chosen) {
        await this.runTests(run, file, [...tests], level);
      }
    } finally {
      run.end();
    }
  }

  /** Reports only the tests that were chosen. */
  private async runTests(run: vscode.TestRun, file: vscode.TestItem, tests: vscode.TestItem[], level: Level) {
    const all = tests.flatMap(withRows);
    if (run.token.isCancellationRequested) {
      all.forEach(item => run.skipped(item));
      return;
    }
    all.forEach(item => run.started(item));
    const results = await this.results(run, file, tests, level);
    if (typeof results === "string") {
      all.forEach(item => run.errored(item, new vscode.TestMessage(results)));
    } else if (results === undefined) {
      all.forEach(item => run.skipped(item));
    } else {
      tests.forEach(test => this.report(run, test, results));
    }
  }

  /** The results of a file's tests; `undefined` if the run was stopped, or the reason why there are none. */
  private async results(run: vscode.TestRun, item: vscode.TestItem, tests: vscode.TestItem[], level: Level) {
    const file = item.uri!;
    const program = await this.program.path();
    if (program === undefined) {
      return "`nbc` was not found";
    }
    if (!(await save(file))) {
      return "the file could not be saved";
    }
    // Lines are those of the saved text.
    await this.items.refresh(file);
    const all: Results = { tests: [], claims: [] };
    for (const [kind, ...only] of this.choices(item, tests)) {
      const levels = kind === "prove" || level === "auto" ? [] : [`--${level}`];
      const args = [kind, "--format", "json", ...levels, ...only, file.fsPath];
      this.log.info(`${program} ${args.join(" ")}`);
      try {
        const finished = await runProgram(program, args, folderOf(file), run.token);
        if (finished.stopped) {
          return undefined;
        }
        if (finished.status !== 0 && finished.status !== 1) {
          return readFaults(finished.stdout, finished.stderr);
        }
        if (kind === "prove") {
          all.claims.push(...readClaims(finished.stdout));
        } else {
          all.tests.push(...readResults(finished.stdout));
        }
      } catch (error) {
        return error instanceof Error ? error.message : String(error);
      }
    }
    return all;
  }

  /** The runs of some tests and claims of a file: for each kind, one run for all of them, or one for each name. */
  private choices(file: vscode.TestItem, tests: vscode.TestItem[]): Choice[] {
    const declared = (items: vscode.TestItem[]) => items.flatMap(item => this.items.test(item) ?? []);
    const all = declared([...file.children].map(([, item]) => item));
    return (["test", "prove"] as const).flatMap((kind): Choice[] => {
      const isOfKind = (one: DeclaredTest) => one.kind === kind;
      const own = declared(tests).filter(isOfKind);
      if (own.length === all.filter(isOfKind).length) {
        return own.length === 0 ? [] : [[kind]];
      }
      return [...new Set(own.map(nameOf))].map(name => [kind, `--only=${name}`]);
    });
  }

  private report(run: vscode.TestRun, item: vscode.TestItem, results: Results): void {
    const test = this.items.test(item);
    const uri = item.uri!;
    if (test === undefined) {
      return;
    }
    const isTest = test.kind === "test";
    const verdict = isTest ? verdictOf(test, results.tests) : verdictOfClaim(test, results.claims);
    settle(run, item, verdict.state, messages(uri, verdict.failures));
    const rows = rowsOf(item);
    verdict.rows.forEach(
      ({ state, failures }, at) => rows[at] && settle(run, rows[at], state, messages(uri, failures)),
    );
    verdict.failures
      .concat(verdict.rows.flatMap(row => row.failures))
      .forEach(failure => run.appendOutput(`${failure.message.replaceAll("\n", "\r\n    ")}\r\n`, undefined, item));
  }

  /** The tests that a request names, by itself, by their file or by one of their rows. */
  private chosen(request: vscode.TestRunRequest): Chosen {
    const excluded = new Set(request.exclude);
    const chosen: Chosen = new Map();
    const choose = (item: vscode.TestItem): void => {
      if (excluded.has(item)) {
        return;
      }
      if (item.parent === undefined) {
        item.children.forEach(choose);
      } else if (this.items.test(item) === undefined) {
        // Rows are a sequence, so a test runs as a whole.
        choose(item.parent);
      } else {
        chosen.set(item.parent, (chosen.get(item.parent) ?? new Set()).add(item));
      }
    };
    (request.include ?? [...this.controller.items].map(([, item]) => item)).forEach(choose);
    return chosen;
  }
}

function settle(run: vscode.TestRun, item: vscode.TestItem, state: string, messages: vscode.TestMessage[]): void {
  if (state === "passed") {
    run.passed(item);
  } else if (state === "failed") {
    run.failed(item, messages);
  } else {
    run.errored(item, new vscode.TestMessage("nbc reported no result"));
  }
}

function messages(file: vscode.Uri, failures: Failure[]): vscode.TestMessage[] {
  return failures.map(({ message, expected, observed, line }) => {
    const isCompared = expected !== undefined && observed !== undefined;
    const shown = isCompared ? vscode.TestMessage.diff(message, expected, observed) : new vscode.TestMessage(message);
    shown.location = new vscode.Location(file, new vscode.Position(line - 1, 0));
    return shown;
  });
}

function rowsOf(test: vscode.TestItem): vscode.TestItem[] {
  return [...test.children].map(([, row]) => row).sort((a, b) => (a.sortText! < b.sortText! ? -1 : 1));
}

function withRows(test: vscode.TestItem): vscode.TestItem[] {
  return [test, ...rowsOf(test)];
}
