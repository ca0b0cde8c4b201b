// The texts of a schematic, which keep a size that can be read at any scale, and whole words. A gate says what it
// computes, in several lines if need be, and its robot is shown where there is room for both.

import type { Box } from "./viewport";

/** The width of a text in pixels, in letters of `size` pixels. */
export type Measure = (text: string, size: number, bold: boolean) => number;

/** What one sees: parts with their names, gates too, or the robots that play them. */
export type Level = "blocks" | "gates" | "robots";

export const LEAST = 11;
/** The smallest scales at which there is room for a gate's name, for a robot, and for its name. */
const GATES = 0.28;
const ROBOTS = 0.46;
const ROBOT_NAMES = 0.8;
/** The height of a robot, in units of the drawing. */
const ROBOT = 52;
/** Pixels from line to line, for the smallest letters, and beside a text in its box. */
const LINE = 13;
const BESIDE = 3;

export function levelOf(scale: number): Level {
  return scale < GATES ? "blocks" : scale < ROBOTS ? "gates" : "robots";
}

/** A text, or its last words if there is no room for more; none if there is room for no whole word. */
export function fitText(text: string, room: number, width: (text: string) => number): string {
  const ends = [...text.matchAll(/(?<=[/_.])\w|\[/g)].map(({ index }) => `…${text.slice(index)}`);
  return [text, ...ends].find(wanted => width(wanted) <= room) ?? "";
}

/** A call such as `q = xor(and(a, b), c)`, and shorter ones, without what is inside of parentheses first. */
function shorterCalls(text: string): string[] {
  const inner = text.replace(/(?<=\(.*)\((?:[^()]|\([^()]*\))*\)/g, "(…)");
  return [text, inner, text.replace(/\(.*$/, "(…)")];
}

/** As much of a call as there is room for. */
export function fitCall(text: string, room: number, width: (text: string) => number): string {
  return shorterCalls(text).find(wanted => width(wanted) <= room) ?? fitText(text, room, width);
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

/** The texts of a box that the drawing may have cut: what a gate computes and its robot, or a part and what it is. */
function wholeTexts(kind: Kind, part: SVGElement | null): string[] {
  const title = part?.querySelector(":scope > title")?.textContent ?? "";
  if (kind === "part") {
    return title.split(/: (?=[^:]*$)|, (?=\d+ robots?$)/);
  }
  return kind === "cell" ? [part?.dataset["call"] ?? title] : [];
}

interface Line {
  element: SVGTextElement;
  text: string;
  /** In units of the drawing. */
  size: number;
  bold: boolean;
}

type Kind = "cell" | "part" | "input" | "output" | "box";

interface Labelled {
  kind: Kind;
  box: Box;
  lines: Line[];
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
      if (kind !== undefined) {
        this.#add(kind, part.querySelector("rect"), [...part.querySelectorAll<SVGTextElement>(":scope > text")], part);
      }
    }
    for (const text of svg.querySelectorAll<SVGTextElement>(":scope > rect + text")) {
      this.#add("box", text.previousElementSibling as SVGRectElement, [text], null);
    }
  }

  /** The pixels that the names of ports need beside the drawing, left and right, at a scale. */
  beside(scale: number): [number, number] {
    const widest = (kind: Kind): number =>
      Math.max(
        0,
        ...this.#all
          .filter(label => label.kind === kind && !this.#fits(label, scale))
          .map(({ lines: [name] }) => (name === undefined ? 0 : this.#width(name, LEAST) + 2 * BESIDE)),
      );
    return [widest("input"), widest("output")];
  }

  /** Arranges all texts for a scale, in pixels of a unit; names of ports have at most `most` pixels. */
  arrange(scale: number, most: number): void {
    const ends = new Map<string, number[]>();
    for (const label of this.#all) {
      if (label.kind === "cell") {
        this.#arrangeCell(label, scale);
      } else if (label.kind === "part") {
        this.#arrangeLines(label, label.lines, scale, "middle");
      } else {
        this.#arrangePort(label, scale, most, ends);
      }
    }
  }

  #add(kind: Kind, frame: SVGRectElement | null, texts: SVGTextElement[], part: SVGElement | null): void {
    if (frame === null) {
      return;
    }
    const number = (name: string): number => Number(frame.getAttribute(name));
    const whole = wholeTexts(kind, part);
    const lines = texts
      .filter(text => !text.classList.contains("thread"))
      .map((text, i) => ({
        element: text,
        text: whole[i] ?? text.textContent ?? "",
        size: Number(text.getAttribute("font-size")),
        bold: text.getAttribute("font-weight") === "bold",
      }));
    const box = { x: number("x"), y: number("y"), width: number("width"), height: number("height") };
    const drawn = part?.querySelector<SVGElement>(":scope > g[transform]") ?? null;
    const at = /translate\(([-\d.]+) ([-\d.]+)\)/.exec(drawn?.getAttribute("transform") ?? "");
    const body = drawn === null || at === null ? null : { element: drawn, x: Number(at[1]), y: Number(at[2]) };
    this.#all.push({ kind, box, lines, body, thread: texts.find(text => text.classList.contains("thread")) ?? null });
  }

  #width({ text, bold }: Line, size: number): number {
    return this.measure(text, size, bold);
  }

  #fits({ box, lines: [name] }: Labelled, scale: number): boolean {
    const room = name !== undefined && this.#width(name, LEAST) <= box.width * scale - 2 * BESIDE;
    return room && box.height * scale >= LEAST + 1;
  }

  #arrangeCell({ box, body, lines: [gate, net, robot], thread }: Labelled, scale: number): void {
    if (gate === undefined) {
      return;
    }
    show(net?.element ?? null, false);
    const [size, line] = [Math.max(LEAST, 11 * scale), Math.max(LINE, 15 * scale)];
    const room = box.width * scale - 2 * BESIDE - (thread === null ? 0 : 14);
    const high = box.height * scale - 2;
    // The pixels below a robot, with and without its name; without a robot, the call has all of the box.
    const below = scale >= ROBOT_NAMES && robot !== undefined ? [Math.max(19 * scale, 15), 5] : [5];
    const level = levelOf(scale);
    const places = level === "blocks" ? [] : body === null || level === "gates" ? [null] : [...below, null];
    const measured = (text: string): number => this.measure(text, size, false);
    const ways = [...shorterCalls(gate.text), gate.text.replace(/ = .*|\(.*/, "")].flatMap(text =>
      places.map(under => {
        const most = (under === null ? high : high - ROBOT * scale - under) / line;
        return { under, call: wrapCall(text, room, Math.floor(most), measured) };
      }),
    );
    const { under, call } = ways.find(way => way.call !== null) ?? { under: null, call: null };
    show(body?.element ?? null, under !== null);
    if (body !== null && under !== null) {
      body.element.setAttribute("transform", `translate(${body.x} ${body.y + 19 - under / scale}) scale(1)`);
    }
    show(robot?.element ?? null, false);
    if (robot !== undefined && under !== null && under > 5) {
      this.#place(robot, box.x + box.width / 2, box.y + box.height - 6 / Math.max(scale, 1), "middle", room, scale);
    }
    show(gate.element, call !== null);
    if (call !== null) {
      const isAlone = under === null;
      const first = isAlone ? box.y + (box.height - (call.length * line) / scale) / 2 : box.y;
      setSize(gate.element, size, scale);
      gate.element.setAttribute("font-weight", "normal");
      gate.element.setAttribute("text-anchor", isAlone ? "middle" : "start");
      const x = isAlone ? box.x + box.width / 2 : box.x + BESIDE / scale;
      gate.element.replaceChildren(...call.map((part, i) => span(part, x, first + ((i + 0.78) * line) / scale)));
    }
    if (thread !== null) {
      show(thread, call !== null);
      setSize(thread, Math.max(LEAST, 13 * scale), scale);
      put(thread, box.x + box.width - 4 / scale, box.y + 12 / scale, "end");
    }
  }

  /** Lines in the middle of their box, as many as there is room for. */
  #arrangeLines({ box }: Labelled, lines: Line[], scale: number, anchor: Anchor): void {
    const line = Math.max(LINE, 15 * scale) / scale;
    const room = box.width * scale - 2 * BESIDE;
    // Only the name may be shortened.
    const whole = lines.filter((text, i) => i === 0 || this.#width(text, Math.max(LEAST, text.size * scale)) <= room);
    const shown = whole.slice(0, Math.floor((box.height * scale - 4) / LINE));
    lines.filter(text => !shown.includes(text)).forEach(text => show(text.element, false));
    const top = box.y + box.height / 2 - (shown.length * line) / 2;
    shown.forEach((text, i) => {
      this.#place(text, box.x + box.width / 2, top + (i + 0.78) * line, anchor, room, scale);
    });
  }

  /** In its box, or else outside beside it, where no other name is. */
  #arrangePort(label: Labelled, scale: number, most: number, ends: Map<string, number[]>): void {
    const { kind, box, lines } = label;
    const [name] = lines;
    if (name === undefined) {
      return;
    }
    const middle = box.y + box.height / 2;
    if (this.#fits(label, scale)) {
      const size = Math.max(LEAST, name.size * scale);
      const y = middle + (0.36 * size) / scale;
      this.#place(name, box.x + box.width / 2, y, "middle", box.width * scale, scale);
      return;
    }
    const column = `${kind} ${box.x}`;
    const taken = ends.get(column) ?? [];
    const isFree = taken.every(other => Math.abs(middle * scale - other) >= LEAST + 1);
    if (kind === "box" || !isFree) {
      show(name.element, false);
      return;
    }
    ends.set(column, [...taken, middle * scale]);
    const [x, anchor] =
      kind === "input" ? [box.x - BESIDE / scale, "end"] : [box.x + box.width + BESIDE / scale, "start"];
    this.#place(name, x as number, middle + (0.36 * LEAST) / scale, anchor as Anchor, most, scale);
  }

  #place(line: Line, x: number, y: number, anchor: Anchor, room: number, scale: number): void {
    const size = Math.max(LEAST, line.size * scale);
    // A name that would be shortened may be less bold.
    const bold = line.bold && this.measure(line.text, size, true) <= room;
    const text = fitText(line.text, room, part => this.measure(part, size, bold));
    line.element.setAttribute("font-weight", bold ? "bold" : "normal");
    show(line.element, text !== "");
    if (text !== "") {
      line.element.textContent = text;
      setSize(line.element, size, scale);
      put(line.element, x, y, anchor);
    }
  }
}

type Anchor = "start" | "middle" | "end";

function setSize(text: SVGTextElement, pixels: number, scale: number): void {
  text.setAttribute("font-size", ((pixels + 0.05) / scale).toFixed(4));
}

function put(text: SVGTextElement, x: number, y: number, anchor: Anchor): void {
  text.setAttribute("x", String(x));
  text.setAttribute("y", String(y));
  text.setAttribute("text-anchor", anchor);
  show(text, true);
}

function span(text: string, x: number, y: number): SVGTSpanElement {
  const part = document.createElementNS("http://www.w3.org/2000/svg", "tspan");
  part.textContent = text;
  part.setAttribute("x", String(x));
  part.setAttribute("y", String(y));
  return part;
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
