// The texts of a schematic, which keep a size that can be read at any scale, and whole words. A gate says what it
// computes, in several lines if need be, and its robot is shown where there is room for both.

import type { Box } from "./viewport";

/** The width of a text in pixels, in letters of `size` pixels. */
export type Measure = (text: string, size: number, bold: boolean) => number;

export const LEAST = 11;
/** The smallest scale at which there is room for a robot, and its height in units of the drawing. */
const ROBOTS = 0.46;
const ROBOT = 52;
/** Pixels from line to line, for the smallest letters, and beside a text in its box. */
const LINE = 13;
const BESIDE = 2;

/** A text, or its last words if there is no room for more; none if there is room for no whole word. */
export function fitText(text: string, room: number, width: (text: string) => number): string {
  const ends = [...text.matchAll(/(?<=[/_.])\w|\[/g)].map(({ index }) => `…${text.slice(index)}`);
  return [text, ...ends].find(wanted => width(wanted) <= room) ?? "";
}

/** A call such as `q = xor(and(a, b), c)`, and shorter ones, without what is inside of parentheses first. */
function shorterCalls(text: string): string[] {
  const inner = text.replace(/(?<=\(.*)\((?:[^()]|\([^()]*\))*\)/g, "(…)");
  return [text, inner, text.replace(/\(.*$/, "(…)"), text.replace(/ = .*|\(.*/, "")];
}

/** As much of a call or a name as there is room for. */
export function fitCall(text: string, room: number, width: (text: string) => number): string {
  return shorterCalls(text).find(wanted => width(wanted) <= room) ?? fitText(text.replace(/\(.*/, ""), room, width);
}

/** The lines of a call, broken between its arguments or else after parentheses; null if there are more than `most`. */
export function wrapCall(text: string, room: number, most: number, width: (text: string) => number): string[] | null {
  const fits = (line: string): boolean => width(line.trimEnd()) <= room;
  for (const breaks of [/(?<=, )/, /(?<=[ (])(?!…)/]) {
    const lines: string[] = [];
    for (const word of text.split(breaks)) {
      const longer = (lines.at(-1) ?? "") + word;
      lines.splice(lines.length > 0 && fits(longer) ? -1 : lines.length, 1, fits(longer) ? longer : word);
    }
    if (lines.length <= most && lines.every(fits)) {
      return lines;
    }
  }
  return null;
}

type Kind = "cell" | "part" | "input" | "output" | "box";

interface Labelled {
  kind: Kind;
  box: Box;
  /** What is drawn, and what it would say if there were room for all. */
  text: SVGTextElement;
  words: string;
  /** The drawing of a robot, and where it came. */
  body: { element: SVGElement; x: number; y: number } | null;
  thread: SVGTextElement | null;
}

export class Labels {
  readonly #all: Labelled[] = [];

  /** Those of a drawing without title and legend, whose boxes are groups or pairs of a rectangle and a text. */
  constructor(
    svg: SVGSVGElement,
    private readonly measure: Measure,
  ) {
    for (const part of svg.querySelectorAll<SVGElement>(":scope > [data-id]")) {
      const kind = /^(cell|part|input|output)-/.exec(part.dataset["id"] ?? "")?.[1] as Kind | undefined;
      const [text, ...others] = part.querySelectorAll<SVGTextElement>(":scope > text:not(.thread)");
      if (kind !== undefined && text !== undefined) {
        others.forEach(other => other.remove());
        const title = part.querySelector(":scope > title")?.textContent;
        this.#add(kind, part.querySelector("rect"), text, part.dataset["call"] ?? title ?? "");
      }
    }
    for (const text of svg.querySelectorAll<SVGTextElement>(":scope > rect + text")) {
      this.#add("box", text.previousElementSibling as SVGRectElement, text, text.textContent ?? "");
    }
  }

  /** Follows a drawing that becomes wider by a factor; robots stay in the middle of their boxes. */
  widen(factor: number): void {
    for (const { box, body } of this.#all) {
      if (body !== null) {
        body.x += (box.x + box.width / 2) * (factor - 1);
      }
      box.x *= factor;
      box.width *= factor;
    }
  }

  /** The pixels that the names of ports need beside the drawing, left and right, at a scale. */
  beside(scale: number): [number, number] {
    const outside = this.#all.filter(label => !this.#fits(label, scale));
    const widest = (kind: Kind): number => {
      const ports = outside.filter(label => label.kind === kind);
      return Math.max(0, ...ports.map(({ words }) => this.measure(words, LEAST, true) + 2 * BESIDE));
    };
    return [widest("input"), widest("output")];
  }

  /** Arranges all texts for a scale, in pixels of a unit; names of ports have at most `most` pixels. */
  arrange(scale: number, most: number): void {
    const ends = new Map<string, number[]>();
    for (const label of this.#all) {
      if (label.kind === "cell") {
        this.#arrangeCell(label, scale);
      } else if (label.kind === "part") {
        this.#arrangePart(label, scale);
      } else {
        this.#arrangePort(label, scale, most, ends);
      }
    }
  }

  #add(kind: Kind, frame: SVGRectElement | null, text: SVGTextElement, words: string): void {
    if (frame === null) {
      return;
    }
    const [x = 0, y = 0, width = 0, height = 0] = ["x", "y", "width", "height"].map(name =>
      Number(frame.getAttribute(name)),
    );
    const within = kind === "cell" ? frame.parentElement : null;
    const drawn = within?.querySelector<SVGElement>(":scope > g[transform]") ?? null;
    const at = /translate\(([-\d.]+) ([-\d.]+)\)/.exec(drawn?.getAttribute("transform") ?? "");
    const body = drawn === null || at === null ? null : { element: drawn, x: Number(at[1]), y: Number(at[2]) };
    const thread = within?.querySelector<SVGTextElement>(":scope > .thread") ?? null;
    text.setAttribute("font-weight", kind === "cell" || kind === "part" ? "normal" : "bold");
    this.#all.push({ kind, box: { x, y, width, height }, text, words, body, thread });
  }

  #fits({ box, words }: Labelled, scale: number): boolean {
    const room = this.measure(words, LEAST, true) <= box.width * scale - 2 * BESIDE;
    return room && box.height * scale >= LEAST + 1;
  }

  #arrangeCell({ box, text, words, body, thread }: Labelled, scale: number): void {
    const room = box.width * scale - 2 * BESIDE - (thread === null ? 0 : 14);
    // The pixels for the robot, if it can be seen and there is room for it and the call.
    const places = body === null || scale < ROBOTS ? [0] : [ROBOT * scale + 5, 0];
    const width = (part: string): number => this.measure(part, sizeAt(scale), false);
    const ways = shorterCalls(words).flatMap(call =>
      places.map(below => {
        const most = Math.floor((box.height * scale - 2 - below) / lineAt(scale));
        return { below, lines: wrapCall(call, room, most, width) };
      }),
    );
    const { below, lines } = ways.find(way => way.lines !== null) ?? { below: 0, lines: null };
    show(body?.element ?? null, below > 0);
    if (below > 0) {
      body?.element.setAttribute("transform", `translate(${body.x} ${body.y + 19 - 5 / scale}) scale(1)`);
      this.#write(text, lines ?? [], [box.x + BESIDE / scale, box.y], "start", scale);
    } else {
      this.#center(text, lines ?? [], box, scale);
    }
    if (thread !== null) {
      const [x, y, size] = [box.x + box.width - 4 / scale, box.y + 12 / scale, Math.max(LEAST, 13 * scale) / scale];
      Object.entries({ x, y, "font-size": size, "text-anchor": "end" }).forEach(([name, value]) =>
        thread.setAttribute(name, String(value)),
      );
    }
  }

  /** The name of a part, what it is, and its robots: as many of them as there is room for. */
  #arrangePart({ box, text, words }: Labelled, scale: number): void {
    const lines = words.split(/: (?=[^:]*$)|, (?=\d+ robots?$)/);
    const fits = (line: string): boolean => this.measure(line, sizeAt(scale), false) <= box.width * scale - 2 * BESIDE;
    const first = lines.findIndex(line => !fits(line));
    const most = Math.floor((box.height * scale - 4) / lineAt(scale));
    this.#center(text, lines.slice(0, Math.min(most, first < 0 ? lines.length : first)), box, scale);
  }

  /** In its box, or else outside beside it, where no other name is. */
  #arrangePort(label: Labelled, scale: number, most: number, ends: Map<string, number[]>): void {
    const { kind, box, text, words } = label;
    const middle = box.y + box.height / 2;
    const column = `${kind} ${box.x}`;
    const taken = ends.get(column) ?? [];
    const isFree = taken.every(other => Math.abs(middle * scale - other) >= LEAST + 1);
    if (this.#fits(label, scale)) {
      this.#center(text, [words], box, scale);
    } else if (kind === "box" || !isFree) {
      show(text, false);
    } else {
      ends.set(column, [...taken, middle * scale]);
      const name = fitText(words, most, part => this.measure(part, LEAST, true));
      const isInput = kind === "input";
      const x = isInput ? box.x - BESIDE / scale : box.x + box.width + BESIDE / scale;
      this.#write(text, [name], [x, middle - lineAt(scale) / 2 / scale], isInput ? "end" : "start", scale);
    }
  }

  #center(text: SVGTextElement, lines: string[], box: Box, scale: number): void {
    const top = box.y + (box.height - (lines.length * lineAt(scale)) / scale) / 2;
    this.#write(text, lines, [box.x + box.width / 2, top], "middle", scale);
  }

  #write(
    text: SVGTextElement,
    lines: string[],
    [x, top]: [number, number],
    anchor: "start" | "middle" | "end",
    scale: number,
  ): void {
    show(text, lines.length > 0);
    text.setAttribute("font-size", ((sizeAt(scale) + 0.05) / scale).toFixed(4));
    text.setAttribute("text-anchor", anchor);
    const spans = lines.map((line, i) => {
      const part = document.createElementNS(text.namespaceURI, "tspan");
      part.textContent = line;
      part.setAttribute("x", String(x));
      part.setAttribute("y", String(top + ((i + 0.78) * lineAt(scale)) / scale));
      return part;
    });
    text.replaceChildren(...spans);
  }
}

/** The pixels of letters, and from line to line. */
function sizeAt(scale: number): number {
  return Math.max(LEAST, 11 * scale);
}

function lineAt(scale: number): number {
  return Math.max(LINE, 15 * scale);
}

function show(part: SVGElement | null, shown: boolean): void {
  part?.setAttribute("visibility", shown ? "visible" : "hidden");
}

/** Measures with a canvas, and remembers what it has measured. */
export function measuring(font: string): Measure {
  const pen = document.createElement("canvas").getContext("2d") as CanvasRenderingContext2D;
  const known = new Map<string, number>();
  return (text, size, bold) => {
    const key = `${Number(bold)}${text}`;
    let width = known.get(key);
    if (width === undefined) {
      pen.font = `${bold ? "bold " : ""}100px ${font}`;
      width = pen.measureText(text).width / 100;
      known.set(key, width);
    }
    return width * size;
  };
}
