// The texts of a schematic, which keep a size that can be read at any scale. What has no room is left out or cut: far
// away a box has no text, or only its name, nearer its gate and its net, and near its robot, too.

import type { Box } from "./viewport";

/** The width of a text in pixels, in letters of `size` pixels. */
export type Measure = (text: string, size: number, bold: boolean) => number;

/** What one sees: parts with their names, gates too, or the robots that play them. */
export type Level = "blocks" | "gates" | "robots";

export const LEAST = 11;
/** The smallest scales at which there is room for a gate's name, for a robot, for two lines above it, and for its name. */
const GATES = 0.28;
const ROBOTS = 0.46;
const TWO_LINES = 0.6;
const ROBOT_NAMES = 0.8;
/** Letters that are left of a text that is cut. */
const FEWEST = 3;
/** Pixels from line to line, for the smallest letters, and beside a text in its box. */
const LINE = 13;
const BESIDE = 3;

export function levelOf(scale: number): Level {
  return scale < GATES ? "blocks" : scale < ROBOTS ? "gates" : "robots";
}

/** As much of a text as there is room for, and none if that says nothing; the end of a net's path tells most. */
export function fitText(text: string, room: number, width: (text: string) => number, keepsEnd = false): string {
  if (width(text) <= room) {
    return text;
  }
  for (let letters = text.length - 1; letters >= FEWEST; letters--) {
    const cut = keepsEnd ? `…${text.slice(-letters)}` : `${text.slice(0, letters)}…`;
    if (width(cut) <= room) {
      return cut;
    }
  }
  return "";
}

/** As much of a call such as `xor(and(a, b), c)` as there is room for, without what is inside of parentheses first. */
export function fitCall(text: string, room: number, width: (text: string) => number): string {
  const shorter = [text, text.replace(/(?<=\(.*)\((?:[^()]|\([^()]*\))*\)/g, "(…)"), text.replace(/\(.*$/, "(…)")];
  return shorter.find(wanted => width(wanted) <= room) ?? fitText(text, room, width, true);
}

interface Line {
  element: SVGTextElement;
  text: string;
  /** What stands there where the text has no room. */
  short: string;
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
    const lines = texts
      .filter(text => !text.classList.contains("thread"))
      .map((text, i) => ({
        element: text,
        text: (i === 0 ? part?.dataset["label"] : undefined) ?? text.textContent ?? "",
        short: text.textContent ?? "",
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

  #arrangeCell(label: Labelled, scale: number): void {
    const { box, body, lines, thread } = label;
    const [gate, net, robot] = lines;
    const level = levelOf(scale);
    const isNear = level === "robots";
    show(body?.element ?? null, isNear);
    const named = robot !== undefined && isNear && scale >= ROBOT_NAMES;
    if (named) {
      const y = box.y + box.height - 6 / Math.max(scale, 1);
      this.#place(robot, box.x + box.width / 2, y, "middle", box.width * scale, scale);
    } else {
      hide(robot);
    }
    const texts = [gate, net].filter(line => line !== undefined && line.text !== "") as Line[];
    if (level === "blocks") {
      [gate, net, ...(thread === null ? [] : [thread])].forEach(hide);
    } else if (isNear) {
      this.#arrangeHead(label, texts, scale);
    } else {
      this.#arrangeLines(label, texts, scale, "middle");
    }
    if (thread !== null && level !== "blocks") {
      setSize(thread, Math.max(LEAST, 13 * scale), scale);
      put(thread, box.x + box.width - 4 / scale, box.y + 12 / scale, "end");
    }
    if (body !== null && isNear) {
      // It stands on the name of the robot, or on the frame.
      const below = named ? Math.max(19, 15 / scale) : 5 / scale;
      const y = body.y + 19 - below;
      body.element.setAttribute("transform", `translate(${body.x} ${y}) scale(1)`);
    }
  }

  /** The gate above the robot, and its net beside it, or below it where there is room. */
  #arrangeHead({ box, thread }: Labelled, [gate, net]: Line[], scale: number): void {
    const [first, second] = [box.y + Math.max(13, 12 / scale), box.y + Math.max(26, 24 / scale)];
    const room = box.width * scale - 2 * BESIDE - (thread === null ? 0 : 14);
    if (gate !== undefined) {
      this.#place(gate, box.x + BESIDE / scale, first, "start", room, scale);
    }
    if (gate !== undefined && net !== undefined) {
      const rest = room - this.#width(gate, Math.max(LEAST, gate.size * scale)) - 2 * BESIDE;
      if (scale >= TWO_LINES && this.#width(net, LEAST) > rest) {
        this.#place(net, box.x + BESIDE / scale, second, "start", box.width * scale - 2 * BESIDE, scale);
      } else {
        const right = box.x + box.width - (thread === null ? BESIDE : BESIDE + 14) / scale;
        this.#place(net, right, first, "end", rest, scale);
      }
    }
  }

  /** Lines in the middle of their box, as many as there is room for. */
  #arrangeLines({ box }: Labelled, lines: Line[], scale: number, anchor: Anchor): void {
    const line = Math.max(LINE, 15 * scale) / scale;
    const room = box.width * scale - 2 * BESIDE;
    // Only the name may be cut.
    const whole = lines.filter((text, i) => i === 0 || this.#width(text, Math.max(LEAST, text.size * scale)) <= room);
    const shown = whole.slice(0, Math.floor((box.height * scale - 4) / LINE));
    lines.filter(text => !shown.includes(text)).forEach(hide);
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
      hide(name);
      return;
    }
    ends.set(column, [...taken, middle * scale]);
    const [x, anchor] =
      kind === "input" ? [box.x - BESIDE / scale, "end"] : [box.x + box.width + BESIDE / scale, "start"];
    this.#place(name, x as number, middle + (0.36 * LEAST) / scale, anchor as Anchor, most, scale);
  }

  #place(line: Line, x: number, y: number, anchor: Anchor, room: number, scale: number): void {
    const size = Math.max(LEAST, line.size * scale);
    const keepsEnd = /[/[]|^…/.test(line.text);
    // A name that would be cut may be less bold.
    const fits = (text: string, isBold: boolean): boolean => this.measure(text, size, isBold) <= room;
    const wanted = fits(line.text, false) ? line.text : line.short;
    const bold = line.bold && fits(wanted, true);
    const text = fitText(wanted, room, text => this.measure(text, size, bold), keepsEnd);
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

function show(part: SVGElement | null, shown: boolean): void {
  part?.setAttribute("visibility", shown ? "visible" : "hidden");
}

function hide(hidden: Line | SVGTextElement | undefined): void {
  show(hidden === undefined ? null : "element" in hidden ? hidden.element : hidden, false);
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
