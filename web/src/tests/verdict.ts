// The rows of a test with what was expected and observed.

import { counted } from "../counted";
import { button, element } from "../element";
import type { RowVerdict, TestVerdict } from "../protocol";

export interface Leads {
  /** Shows a row, or the test if a file has its rows. */
  line: (line: number) => void;
  /** Shows the row in the run; null if there was no run in physics. */
  moment: ((row: number) => void) | null;
}

/** More rows than this are long to read, so passing ones are left out. */
const MANY = 64;

/** The world of tests and swarms that name none. */
const PAPER = "paper";

export function verdictTable(verdict: TestVerdict, leads: Leads): HTMLElement {
  const rows = verdict.rows.length > MANY ? verdict.rows.filter(row => !row.passed).slice(0, MANY) : verdict.rows;
  const left = verdict.rows.length - rows.length;
  const swarm = verdict.swarm === null ? [] : [`swarm ${verdict.swarm}`];
  const world = verdict.world === null || verdict.world === PAPER ? [] : [`in ${verdict.world}`];
  const heading = [...swarm, ...world].join(" ");
  return element(
    "div",
    { class: "scroll" },
    heading === "" ? null : element("h4", {}, heading),
    verdict.fault !== undefined && element("p", { class: "verdict fail" }, verdict.fault),
    element(
      "table",
      { class: "rows" },
      head(verdict),
      element("tbody", {}, ...rows.map(row => tableRow(row, leads, verdict))),
    ),
    left > 0 && element("p", { class: "dim" }, counted(left, "more row")),
    verdict.printed !== undefined &&
      element("figure", {}, element("figcaption", {}, "Written"), element("pre", {}, verdict.printed)),
  );
}

function head(verdict: TestVerdict): HTMLElement {
  const names = (ports: { name: string }[]): HTMLElement[] =>
    ports.map(port => element("th", { scope: "col" }, port.name));
  return element(
    "thead",
    {},
    element(
      "tr",
      {},
      element("th", { scope: "colgroup", colspan: verdict.inputs.length, class: "group" }, "inputs"),
      element("th", { scope: "colgroup", colspan: verdict.outputs.length, class: "group" }, "expected"),
      element("th", { scope: "colgroup", colspan: verdict.outputs.length, class: "group" }, "observed"),
      hasThreads(verdict) && element("th", { rowspan: 2 }, ""),
      element("th", { rowspan: 2 }, ""),
      element("th", { rowspan: 2 }, ""),
    ),
    element("tr", {}, ...names(verdict.inputs), ...names(verdict.outputs), ...names(verdict.outputs)),
  );
}

/** Whether a row says its thread, as those of a wave machine do. */
function hasThreads(verdict: TestVerdict): boolean {
  return verdict.rows.some(row => row.thread !== undefined);
}

function tableRow(row: RowVerdict, leads: Leads, verdict: TestVerdict): HTMLElement {
  const from = verdict.rows_from;
  const place = from === undefined ? `line ${row.line}` : `line ${row.line} of ${from.file.split("/").at(-1)}`;
  const line = from === undefined ? row.line : verdict.line;
  const cells = (values: { text: string }[]): HTMLElement[] =>
    values.map((value, i) => element("td", { class: i === 0 ? "first" : "" }, value.text));
  return element(
    "tr",
    { "data-passed": row.passed, "data-row": row.row },
    ...cells(row.inputs),
    ...cells(row.expected),
    ...cells(row.observed),
    hasThreads(verdict) &&
      element("td", { class: "thread" }, row.thread === undefined ? "" : `thread ${row.thread + 1}`),
    element("td", { class: row.passed ? "pass" : "fail" }, row.passed ? "✓ pass" : "✗ fail"),
    element(
      "td",
      { class: "leads" },
      button(place, () => leads.line(line), { class: "link", "data-do": "line" }),
      leads.moment !== null &&
        button("show the moment", () => leads.moment?.(row.row), { class: "link", "data-do": "moment" }),
    ),
  );
}

/** How many rows of a file passed, and how many should, as `343 of 360, at least 93 %`. */
export function shareOf(results: TestVerdict[]): string[] {
  return results.flatMap(({ rows, rows_from: from }) => {
    const passed = rows.filter(row => row.passed).length;
    return from?.at_least === undefined ? [] : [`${passed} of ${rows.length}, at least ${from.at_least} %`];
  });
}
