// What is wrong with the program, as a list below it: each entry leads to its line.

import { element, fill } from "../element";
import type { Program } from "../program";
import type { Finding } from "../protocol";

const MOST = 50;

export function problemList(program: Program, reveal: (line: number) => void): HTMLElement {
  const host = element("ul", { class: "problems", "aria-label": "What is wrong", hidden: true });
  program.checked.follow(checked => {
    const found = [...(checked?.diagnostics ?? [])].sort(
      (a, b) => Number(b.severity === "error") - Number(a.severity === "error"),
    );
    host.hidden = found.length === 0;
    fill(
      host,
      ...found.slice(0, MOST).map(one => element("li", { "data-severity": one.severity }, entry(one, program, reveal))),
      found.length > MOST && element("li", {}, `and ${found.length - MOST} more`),
    );
  });
  return host;
}

function entry({ message, help, labels }: Finding, program: Program, reveal: (line: number) => void): HTMLElement {
  const [label] = labels;
  const line = label?.start.line ?? 0;
  const isHere = label !== undefined && label.file === program.path.value;
  const place = label === undefined ? "" : isHere ? `line ${line}: ` : `${label.file}:${line}: `;
  return element(
    "button",
    { type: "button", disabled: !isHere, onclick: () => reveal(line) },
    element("b", {}, place),
    message,
    help !== null && element("span", { class: "dim" }, ` · ${help}`),
  );
}
