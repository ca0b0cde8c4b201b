// The schematic with the values of nets and robots. Zooming in opens a part; zooming out closes it.

import { button, element, fill, iconButton } from "../element";
import type { StimulusSource, SchematicPages } from "../protocol";
import { sameSource } from "../selection";
import type { LiveSwarm } from "./swarm";
import type { View } from "./animation";
import { Dragging } from "./dragging";
import { Labels, measuring } from "./labels";
import { addHalo, drawingOf, leaveDrawing, pathTo, placeBodies, threadNumber, widen } from "./schematic_parts";
import { LARGEST_WHOLE, Viewport, type Box, type Margins } from "./viewport";
import { threadColor } from "./waves";

interface Marked {
  element: Element;
  source: StimulusSource;
  shown: number | null | undefined;
  /** What shows the number of the thread, and which is shown. */
  number: Element | null;
  thread: number | null;
}
/** A scale that is good for reading, a step of the zoom, and the share of the pane at which a part is opened. */
const READABLE = 0.8;
const STEP = 1.25;
const OPENS = 0.5;
const MARGIN = 10;
/** The most of the pane's width for the names of ports on a side. */
const NAMES = 0.22;
/** A drawing that has all the height of the pane can become so much wider, which gives more room to the texts. */
const WIDEST = 2;
const FONT = '"DejaVu Sans", Verdana, sans-serif';

export class Schematic implements View {
  readonly host = element("div", {
    class: "schematic pane",
    tabindex: 0,
    role: "group",
    "aria-label": "Schematic of the circuit",
  });
  readonly tools = [
    iconButton("more", "Zoom in (+)", () => this.#zoom(STEP)),
    iconButton("less", "Zoom out (-)", () => this.#zoom(1 / STEP)),
    iconButton("whole", "Show all of the schematic (0)", () => this.#fit()),
  ];
  /** The sheets from the whole to the one that is shown. */
  readonly crumbs = element("nav", { class: "crumbs", "aria-label": "Part of the circuit" });
  #schematic: SchematicPages = { sheets: [], bodies: [], homes: [] };
  #sheet = 0;
  #svg: SVGSVGElement | null = null;
  /** The robots, of which one is reached by the tab key. */
  #robots: SVGElement[] = [];
  #marked: Marked[] = [];
  #labels: Labels | null = null;
  #whole: Box = { x: 0, y: 0, width: 1, height: 1 };
  #factor = 1;
  readonly #view = new Viewport();
  /** Whether the reader has zoomed or moved; else the whole is shown in a pane of any size. */
  #isOwn = false;
  readonly #measure = measuring(FONT);

  constructor(private readonly swarm: LiveSwarm) {
    swarm.definition.on(definition => {
      this.#schematic = definition?.schematic ?? { sheets: [], bodies: [], homes: [] };
      this.#load(0);
    });
    swarm.selection.pointed.on(() => this.#select());
    swarm.selection.followed.on(robot => {
      this.#select();
      this.#reveal(robot);
    });
    this.#listen();
    new ResizeObserver(() => this.#resize()).observe(this.host);
  }

  draw(): void {
    if (this.#view.width === 0) {
      return;
    }
    for (const marked of this.#marked) {
      const value = this.swarm.value(marked.source);
      if (value !== marked.shown) {
        marked.shown = value;
        marked.element.classList.toggle("one", value === 1);
        marked.element.classList.toggle("zero", value === 0);
      }
      const thread = this.swarm.thread(marked.source);
      if (thread !== marked.thread) {
        marked.thread = thread;
        showThread(marked, thread);
      }
    }
  }

  #resize(): void {
    const hidden = this.#view.width === 0;
    // Not rounded to pixels, as the client's width is.
    const { width, height } = this.host.getBoundingClientRect();
    this.#view.width = Math.max(0, width - 2 * this.host.clientLeft);
    this.#view.height = Math.max(0, height - 2 * this.host.clientTop);
    if (this.#view.width > 0 && this.#view.height > 0) {
      if (hidden || !this.#isOwn) {
        this.#fit();
      } else {
        this.#show();
      }
    }
  }

  /** Opens a sheet, and shows the robots of its part alone. */
  #open(sheet: number): void {
    this.#load(sheet);
    const { homes, sheets } = this.#schematic;
    const inside = [...homes.keys()].filter(robot => pathTo(sheets, homes[robot] ?? 0).includes(sheet));
    this.swarm.selection.opened.set(sheet === 0 ? null : inside);
    this.draw();
  }

  #load(sheet: number): void {
    this.#sheet = sheet;
    const { sheets, bodies } = this.#schematic;
    this.#marked = [];
    this.#robots = [];
    this.#labels = null;
    this.#svg = drawingOf(sheets[sheet]);
    if (this.#svg === null) {
      this.host.replaceChildren(element("p", { class: "empty" }, "This circuit has no schematic."));
      return;
    }
    const { name, about } = sheets[sheet] ?? { name: "", about: "" };
    this.#svg.setAttribute("aria-label", `${name}: ${about}`);
    this.#whole = leaveDrawing(this.#svg);
    this.#factor = 1;
    placeBodies(this.#svg, bodies);
    fill(
      this.crumbs,
      ...pathTo(sheets, sheet).map(at => {
        const { name, about } = sheets[at] ?? { name: "", about: "" };
        return button(name, () => this.#open(at), { title: about, "aria-current": at === sheet ? "page" : null });
      }),
    );
    this.crumbs.hidden = sheets.length < 2;
    this.host.replaceChildren(this.#svg);
    this.#mark(this.#svg);
    this.#labels = new Labels(this.#svg, this.#measure);
    this.#fit();
  }

  #mark(svg: SVGSVGElement): void {
    for (const part of svg.querySelectorAll<SVGElement>("[data-id]")) {
      const [, kind, name] = /^(\w+)-(.*)$/.exec(part.dataset["id"] ?? "") ?? [];
      const isNet = kind === "net" || kind === "input" || kind === "output";
      const source = kind === "cell" ? { robot: Number(name) } : isNet ? this.swarm.nets.get(name ?? "") : undefined;
      if (source !== undefined) {
        const threaded = (this.swarm.definition.value?.waves?.threads ?? 1) > 1 && "robot" in source;
        const number = threaded && kind === "cell" ? threadNumber(part) : null;
        if (threaded && kind === "net") {
          addHalo(part);
        }
        this.#marked.push({ element: part, source, shown: undefined, number, thread: null });
      }
      if (isNet) {
        // The panels of inputs and outputs and the robots say the values.
        part.setAttribute("aria-hidden", "true");
      } else if (kind === "part") {
        part.setAttribute("tabindex", "0");
        part.setAttribute("role", "button");
        part.setAttribute("aria-label", `open ${part.querySelector("title")?.textContent ?? name}`);
      } else if (kind === "cell") {
        part.dataset["call"] = this.#callOf(part);
        // One robot for the tab key, and arrows for the others: a large circuit is passed as quickly as a small one.
        part.setAttribute("tabindex", this.#robots.length === 0 ? "0" : "-1");
        this.#robots.push(part);
        part.setAttribute("role", "button");
        part.setAttribute("aria-label", part.querySelector("title")?.textContent ?? `robot ${name}`);
        part.setAttribute("aria-pressed", "false");
      }
    }
  }

  /** What a gate computes, with the names of its nets as they are within the sheet. */
  #callOf(gate: SVGElement): string {
    const { sheets } = this.#schematic;
    const path = pathTo(sheets, this.#sheet).slice(1);
    const title = gate.querySelector("title")?.textContent ?? "";
    return path.reduce((call, at) => call.replaceAll(`${sheets[at]?.name}/`, ""), title.replace(/, robot [^,]*$/, ""));
  }

  #select(): void {
    const { pointed, followed } = this.swarm.selection;
    for (const { element: marked, source } of this.#marked) {
      marked.classList.toggle("pointed", sameSource(source, pointed.value));
      const isFollowed = "robot" in source && source.robot === followed.value;
      marked.classList.toggle("followed", isFollowed);
      if (marked.getAttribute("role") === "button") {
        marked.setAttribute("aria-pressed", String(isFollowed));
      }
    }
  }

  #sourceOf(target: EventTarget | null): StimulusSource | null {
    // Not by the nearest name: a body within a robot's box has one of its own.
    const found = target instanceof Node ? this.#marked.find(({ element }) => element.contains(target)) : undefined;
    return found?.source ?? null;
  }

  /** The sheet that a box opens, if the target is one. */
  #partOf(target: EventTarget | null): number | null {
    const found = target instanceof Element ? target.closest<SVGElement>('[data-id^="part-"]') : null;
    return found === null ? null : Number(found.dataset["id"]?.slice(5));
  }

  /** Shows what the viewport says, with texts that can be read. */
  #show(): void {
    const { x, y, width, height } = this.#view.box;
    this.#svg?.setAttribute("viewBox", `${x} ${y} ${width} ${height}`);
    this.#labels?.arrange(this.#view.scale, NAMES * this.#view.width);
  }

  #fit(): void {
    if (this.#view.width === 0) {
      return;
    }
    this.#isOwn = false;
    this.#widen();
    this.#view.fit(this.#whole, scale => this.#margins(scale));
    this.#show();
  }

  #margins(scale: number): Margins {
    const [left, right] = (this.#labels?.beside(scale) ?? [0, 0]).map(
      name => MARGIN + Math.min(name, NAMES * this.#view.width),
    );
    return { left: left ?? MARGIN, right: right ?? MARGIN, top: MARGIN, bottom: MARGIN };
  }

  #widen(): void {
    const { width, height } = this.#view;
    const scale = Math.min(LARGEST_WHOLE, (height - 2 * MARGIN) / this.#whole.height);
    const { left, right } = this.#margins(scale);
    const wanted = (this.#factor * (width - left - right)) / (this.#whole.width * scale);
    const more = Math.min(WIDEST, Math.max(1, wanted)) / this.#factor;
    if (this.#svg !== null && scale > 0) {
      widen(this.#svg, more);
      this.#labels?.widen(more);
      this.#factor *= more;
      this.#whole.x *= more;
      this.#whole.width *= more;
    }
  }

  #center(part: SVGGraphicsElement, scale: number): void {
    this.#isOwn = true;
    this.#view.center(part.getBBox(), scale);
    this.#show();
  }

  #reveal(robot: number | null): void {
    const home = robot === null ? undefined : this.#schematic.homes[robot];
    if (home !== undefined && home !== this.#sheet) {
      this.#load(home);
      this.#select();
      this.draw();
    }
    const part = this.#svg?.querySelector<SVGGraphicsElement>(`[data-id="cell-${robot}"]`);
    if (part && robot !== null && this.#isOwn) {
      this.#center(part, Math.max(READABLE, this.#view.scale));
    }
  }

  /** Shows `factor` times as large what is at a place of the pane, in pixels; a part there opens when it fills much of it. */
  #zoom(factor: number, x = this.#view.width / 2, y = this.#view.height / 2): void {
    const outer = this.#schematic.sheets[this.#sheet]?.outer ?? null;
    if (factor < 1 && this.#view.isWhole && outer !== null) {
      const before = this.#sheet;
      this.#open(outer);
      const part = this.#svg?.querySelector<SVGGraphicsElement>(`[data-id="part-${before}"]`);
      if (part) {
        this.#center(part, Math.max(READABLE, this.#view.scale));
      }
      return;
    }
    this.#isOwn = true;
    this.#view.zoom(factor, x, y);
    const part = factor > 1 ? this.#partAt(x, y) : null;
    if (part === null) {
      this.#show();
    } else {
      this.#open(part);
    }
  }

  #partAt(x: number, y: number): number | null {
    const { box, scale, width, height } = this.#view;
    const [across, down] = [box.x + x / scale, box.y + y / scale];
    for (const part of this.#svg?.querySelectorAll<SVGGraphicsElement>('[data-id^="part-"]') ?? []) {
      const own = part.getBBox();
      const isThere = across >= own.x && across <= own.x + own.width && down >= own.y && down <= own.y + own.height;
      if (isThere && Math.max((own.width * scale) / width, (own.height * scale) / height) >= OPENS) {
        return this.#partOf(part);
      }
    }
    return null;
  }

  #listen(): void {
    const { selection } = this.swarm;
    const point = (event: Event): void => selection.point(this.#sourceOf(event.target));
    this.host.addEventListener("mouseover", point);
    this.host.addEventListener("focusin", point);
    this.host.addEventListener("mouseleave", () => selection.point(null));
    this.host.addEventListener("keydown", event => this.#press(event));
    const move = (by: [number, number], factor: number, at: [number, number]): void => {
      this.#view.move(...by);
      this.#zoom(factor, ...at);
    };
    // A press that does not move follows a robot or opens a part.
    new Dragging(this.host, move, target => this.#click(target));
  }

  /** Arrows go from robot to robot, Enter follows one, Escape follows all again. */
  #press(event: KeyboardEvent): void {
    const { selection } = this.swarm;
    const source = this.#sourceOf(event.target);
    const part = this.#partOf(event.target);
    if (part !== null && (event.key === "Enter" || event.key === " ")) {
      event.preventDefault();
      this.#open(part);
      return;
    }
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    const factor = { "+": STEP, "=": STEP, "-": 1 / STEP }[event.key];
    if (event.ctrlKey || event.metaKey || event.altKey) {
      return;
    }
    if (step !== undefined) {
      const at = this.#robots.findIndex(robot => robot.tabIndex === 0);
      this.#reach(Math.min(this.#robots.length - 1, Math.max(0, at + step)));
    } else if (factor !== undefined) {
      this.#zoom(factor, ...this.#focus());
    } else if (event.key === "0") {
      this.#fit();
    } else if ((event.key === "Enter" || event.key === " ") && source !== null && "robot" in source) {
      selection.follow(source.robot);
    } else if (event.key === "Escape" && selection.followed.value !== null) {
      selection.followed.set(null);
    } else {
      return;
    }
    event.preventDefault();
  }

  /** The place in the pane of what has the focus, or its middle. */
  #focus(): [number, number] {
    const focused = this.#svg?.querySelector<SVGGraphicsElement>(":focus");
    const { box, scale, width, height } = this.#view;
    if (!focused) {
      return [width / 2, height / 2];
    }
    const own = focused.getBBox();
    const [x, y] = [(own.x + own.width / 2 - box.x) * scale, (own.y + own.height / 2 - box.y) * scale];
    return x > 0 && x < width && y > 0 && y < height ? [x, y] : [width / 2, height / 2];
  }

  #reach(index: number): void {
    this.#robots.forEach((robot, i) => (robot.tabIndex = i === index ? 0 : -1));
    const robot = this.#robots[index];
    robot?.focus();
    if (robot instanceof SVGGraphicsElement && this.#isOwn) {
      this.#center(robot, Math.max(READABLE, this.#view.scale));
    }
  }

  #click(target: EventTarget | null): void {
    const source = this.#sourceOf(target);
    const part = this.#partOf(target);
    if (part !== null) {
      this.#open(part);
    } else if (source !== null && "robot" in source) {
      this.swarm.selection.follow(source.robot);
    }
  }
}

function showThread({ element: part, number }: Marked, thread: number | null): void {
  if (thread === null) {
    part.removeAttribute("data-thread");
  } else {
    part.setAttribute("data-thread", String(threadColor(thread)));
  }
  if (number !== null) {
    number.textContent = thread === null ? "" : String(thread + 1);
  }
}
