// The tests of the program: run them, and go from a failing row to its line or to its moment in the run.

import type { Connection } from "../connection";
import { button, element, fill } from "../element";
import type { LiveSwarm } from "../live/swarm";
import type { Program } from "../program";
import type { TestEntry, Level, TestVerdict } from "../protocol";
import { RequestError } from "../request";
import { type Attempt, attemptBar, Attempts, placeOf } from "./attempts";
import { ClaimCards } from "./claims";
import { shareOf, verdictTable } from "./verdict";

interface Tested {
  level: Level;
  results: TestVerdict[];
}

export type TestState = Attempt<Tested>;

export class TestsPanel {
  readonly host = element("div", { class: "tests" });
  readonly #attempts = new Attempts<Tested>();
  readonly states = this.#attempts.states;
  readonly claims: ClaimCards;
  readonly #list = element("div", { class: "list" });
  readonly #status = element("p", { class: "status", role: "status", "aria-live": "polite" });

  constructor(
    private readonly connection: Connection,
    private readonly program: Program,
    private readonly swarm: LiveSwarm,
    private readonly reveal: (line: number) => void,
    private readonly showSwarm: () => void,
    append: (text: string) => void,
  ) {
    this.claims = new ClaimCards(connection, program, {
      line: reveal,
      settle: () => this.#settle(),
      watch: (circuit, test) => void this.#watch(circuit, test),
      append,
    });
    this.host.append(
      element(
        "div",
        { class: "bar" },
        button("Run all in physics", () => void this.#runAll("physics"), {
          class: "primary",
          "data-do": "all-physics",
        }),
        button("Run all as logic", () => void this.#runAll("logic"), { "data-do": "all-logic" }),
        this.#status,
      ),
      this.#list,
      this.claims.host,
    );
    program.checked.on(() => this.#attempts.clear());
    this.states.follow(() => this.#build());
  }

  #tests(): TestEntry[] {
    return this.program.checked.value?.tests ?? [];
  }

  async #runAll(level: Level): Promise<void> {
    await this.#settle();
    for (const test of this.#tests()) {
      await this.#run(test, level);
    }
  }

  /** Waits for the check of an edit of just now, which would take all results away. */
  async #settle(): Promise<void> {
    this.#status.textContent = "checking the program …";
    await this.program.settled();
    this.#status.textContent = "";
  }

  async #run(test: TestEntry, level: Level): Promise<void> {
    await this.#settle();
    const index = placeOf(test, this.#tests());
    if (index === undefined) {
      this.#status.textContent = "the program has no such test any more";
      return;
    }
    const fields = { path: this.program.path.value, test: index, level };
    await this.#attempts.run(index, async ({ know, ...sending }) => {
      const found = (results: TestVerdict[]): void => know({ level, results });
      return { level, ...(await this.connection.request("test", fields, { ...sending, found })) };
    });
  }

  async #watchDeclared(test: TestEntry): Promise<void> {
    await this.#settle();
    const index = placeOf(test, this.#tests());
    if (index !== undefined) {
      await this.#watch(test.circuit, index);
    }
  }

  /** Shows the swarm while the test gives its inputs, from the start. */
  async #watch(circuit: string, test: number | string): Promise<void> {
    if (await this.#replay(circuit, test, { swarm: null, world: null }, 0)) {
      this.swarm.play();
    }
  }

  /** Shows the swarm of a test at the end of a row, if that is possible. */
  async #replay(
    circuit: string,
    test: number | string,
    verdict: Pick<TestVerdict, "swarm" | "world">,
    row: number,
  ): Promise<boolean> {
    this.#status.textContent = row === 0 ? "compiling the circuit …" : "running the test up to this row …";
    const world = verdict.world === null ? {} : { world: verdict.world };
    try {
      const { swarm } = await this.connection.request(
        "replay",
        { path: this.program.path.value, test, swarm: verdict.swarm, ...world, row },
        { progress: (done, all) => (this.#status.textContent = `running the test up to this row: ${done} of ${all}`) },
      );
      this.program.forgetCompiled({ circuit, swarm: swarm.swarm });
      this.swarm.begin(swarm, true);
      this.showSwarm();
      this.#status.textContent = "";
      return true;
    } catch (error) {
      this.#status.textContent = error instanceof RequestError ? error.message : "";
      return false;
    }
  }

  #build(): void {
    const tests = this.#tests();
    const claims = this.program.checked.value?.claims ?? [];
    if (tests.length === 0 && claims.length === 0) {
      const text = this.program.checked.value?.errors ? "The program has errors." : "This program has no tests.";
      fill(this.#list, element("p", { class: "empty" }, text));
      return;
    }
    fill(this.#list, ...tests.map(test => this.#card(test)));
  }

  #card(test: TestEntry): HTMLElement {
    const state = this.states.value.get(test.index);
    const passed = state?.state === "done" ? String(state.results.every(verdict => verdict.passed)) : "";
    return element(
      "article",
      { class: "card test", "data-test": test.index, "data-state": state?.state ?? "none", "data-passed": passed },
      element(
        "header",
        {},
        element(
          "h3",
          {},
          button(test.circuit, () => this.reveal(test.line), { class: "link", title: `Line ${test.line}` }),
        ),
        element("span", { class: "title" }, test.title),
        element("span", { class: "count" }, test.extent),
      ),
      element(
        "div",
        { class: "bar" },
        !test.ever &&
          button("Run in physics", () => void this.#run(test, "physics"), {
            "data-do": "physics",
            disabled: state?.state === "running",
          }),
        button("Run as logic", () => void this.#run(test, "logic"), {
          "data-do": "logic",
          disabled: state?.state === "running",
        }),
        !test.ever &&
          button("Watch", () => void this.#watchDeclared(test), {
            "data-do": "watch",
            title: "Shows the robots while the test gives their inputs",
          }),
        this.#result(state),
      ),
      ...this.#tables(test, state),
    );
  }

  #result(state: TestState | undefined): HTMLElement | null {
    if (state?.state !== "done") {
      return attemptBar(state);
    }
    const passed = state.results.every(verdict => verdict.passed);
    const level = state.level === "physics" ? "in physics" : "as logic";
    const words =
      state.results[0]?.proof ?? `${passed ? "passes" : "fails"} ${[level, ...shareOf(state.results)].join(": ")}`;
    return element("span", { class: `verdict ${passed ? "pass" : "fail"}` }, `${passed ? "✓" : "✗"} ${words}`);
  }

  #tables(test: TestEntry, state: TestState | undefined): HTMLElement[] {
    const withRows = (state?.results ?? []).filter(verdict => verdict.proof === undefined || verdict.rows.length > 0);
    return withRows.map(verdict =>
      verdictTable(verdict, {
        line: line => this.reveal(line),
        moment: verdict.level === "physics" ? row => void this.#replay(test.circuit, test.index, verdict, row) : null,
      }),
    );
  }
}
