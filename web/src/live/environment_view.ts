// The other side of a circuit's ports while a test runs, beside the robots: what is on the screen, and the memories with
// the words that are read and written.

import { counted } from "../counted";
import { element, fill } from "../element";
import type { ShownEnvironment, ShownMemory } from "../protocol";
import { memoryRows, readAt, screenAt, wordAt } from "./environment";
import { numberText } from "./numbers";

export function environmentView({ name, screen, memories }: ShownEnvironment): {
  parts: HTMLElement[];
  show: (cycle: number) => void;
} {
  const text = element("pre", { "data-screen": "" });
  const tables = memories.map(memoryTable);
  const show = (cycle: number): void => {
    if (screen !== null) {
      setText(text, screenAt(screen, cycle));
    }
    tables.forEach(table => table.show(cycle));
  };
  const parts = [
    element("h3", {}, name),
    screen === null ? null : element("figure", {}, element("figcaption", {}, "screen"), text),
    ...tables.map(table => table.host),
  ];
  return { parts: parts.filter(part => part !== null), show };
}

function memoryTable(memory: ShownMemory): { host: HTMLElement; show: (cycle: number) => void } {
  const caption = element("caption");
  const body = element("tbody");
  let before = "";
  const show = (cycle: number): void => {
    const { rows, left } = memoryRows(memory, cycle);
    const made = rows.map(row => ({ ...row, text: numberText(row.value, row) }));
    const shown = JSON.stringify([left, made.map(({ at, text, isRead, isWritten }) => [at, text, isRead, isWritten])]);
    setText(caption, captionOf(memory, cycle));
    if (shown === before) {
      return;
    }
    before = shown;
    fill(
      body,
      ...made.map(({ at, text, isRead, isWritten }) =>
        element(
          "tr",
          { "data-word": at, "aria-current": isRead ? "true" : null, class: isWritten ? "written" : "" },
          element("th", { scope: "row" }, String(at)),
          element("td", {}, text),
        ),
      ),
      left > 0 && element("tr", {}, element("td", { colspan: 2 }, counted(left, "more word"))),
    );
  };
  return { host: element("table", { class: "rows memory", "data-memory": memory.name }, caption, body), show };
}

/** What a memory reads: the words themselves, such as the instruction of a machine. */
function captionOf(memory: ShownMemory, cycle: number): string {
  const read = readAt(memory, cycle).map(at => `${at}: ${numberText(wordAt(memory, at, cycle), memory)}`);
  return memory.width === 1 || read.length === 0 ? memory.name : `${memory.name}, reads ${read.join(", ")}`;
}

function setText(part: HTMLElement, text: string): void {
  if (part.textContent !== text) {
    part.textContent = text;
  }
}
