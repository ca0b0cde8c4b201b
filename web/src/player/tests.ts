// The rows of the tests, which the page runs through its own logic.

import { counted } from "../counted";
import { button, element, fill } from "../element";
import { offsetOf, toNumber } from "../ports";
import type { ExportedTest, PortEntry } from "../protocol";
import type { Machine } from "./machine";
import { runRows, type RowEnd } from "./rows";

export class TestTable {
  readonly host = element("section", { class: "checks", "aria-label": "Tests" });

  constructor(private readonly machine: Machine) {
    this.host.append(...machine.recording.tests.map(test => this.#test(test)));
  }

  #test(test: ExportedTest): HTMLElement {
    const verdict = element("span", { class: "verdict", role: "status", "aria-live": "polite" });
    const body = element("tbody");
    const show = (ends: RowEnd[] | null): void => fill(body, ...test.rows.map((_, i) => this.#row(test, i, ends?.[i])));
    const run = button(
      "Run the test",
      () => {
        const ends = runRows(this.machine, test);
        const passed = ends.filter(end => end.passed).length;
        verdict.textContent = `${passed} of ${counted(ends.length, "row")} as expected`;
        verdict.className = passed === ends.length ? "verdict pass" : "verdict fail";
        show(ends);
      },
      { "data-do": "test" },
    );
    show(null);
    const { inputs, outputs } = this.machine.swarm;
    const names = (ports: PortEntry[]): HTMLElement[] =>
      ports.map(({ name }, i) => element("th", { scope: "col", class: i === 0 ? "first" : null }, name));
    return element(
      "details",
      { class: "card test", "data-test": test.title },
      element("summary", {}, `Test: ${test.title}`),
      element("p", { class: "row" }, run, verdict),
      element(
        "div",
        { class: "scroll" },
        element(
          "table",
          { class: "rows" },
          element("thead", {}, element("tr", {}, ...names(inputs), ...names(outputs), element("th", {}, ""))),
          body,
        ),
      ),
    );
  }

  #row(test: ExportedTest, index: number, end: RowEnd | undefined): HTMLElement {
    const { inputs, outputs } = this.machine.swarm;
    const row = test.rows[index] ?? { inputs: "", expected: "" };
    const observed = end === undefined || end.passed ? "" : `but was ${valuesOf(outputs, end.observed).join(" ")}`;
    const cells = (values: string[]): HTMLElement[] =>
      values.map((value, i) => element("td", { class: i === 0 ? "first" : null }, value));
    return element(
      "tr",
      { "data-passed": end === undefined ? null : end.passed },
      ...cells(valuesOf(inputs, row.inputs)),
      ...cells(valuesOf(outputs, row.expected)),
      element("td", { class: end?.passed === true ? "pass" : "fail" }, end?.passed === true ? "✓" : observed),
    );
  }
}

/** The value of each port: a bit, a number, or the digits where some of them do not matter. */
function valuesOf(ports: PortEntry[], bits: string): string[] {
  return ports.map(port => {
    const start = offsetOf(ports, port);
    const own = bits.slice(start, start + port.width);
    return port.width === 1 || own.includes("-") ? own : String(toNumber([...own].map(Number)));
  });
}
