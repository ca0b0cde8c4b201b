// The schematic that the server drew, with nets and robots marked by their values now; it can be zoomed and moved.

import { button, element, fill, iconButton } from "../element";
import type { BitSource, ShownSchematic } from "../protocol";
import { sameSource } from "../selection";
import type { LiveSwarm } from "./swarm";
import type { View } from "./animation";
import { addHalo, hideLegend, placeBodies, threadNumber } from "./schematic_parts";
import { threadColor } from "./waves";

interface Marked {
  element: Element;
  source: BitSource;
  shown: number | null | undefined;
  /** What shows the number of the thread, and which is shown. */
  number: Element | null;
  thread: number | null;
}
interface Box {
  x: number;
  y: number;
  width: number;
  height: number;
}

/** A good scale for reading; and those below which the whole cannot be read, and bodies are only noise. */
const READABLE = 0.6;
const UNREADABLE = 0.34;
const FAR = 0.3;

export class Schematic implements View {
  readonly host = element("div", { class: "schematic pane", tabindex: 0, "aria-label": "Schematic of the circuit" });
  readonly #tools: HTMLElement;
  /** The sheets from the whole to the one that is shown. */
  readonly #crumbs = element("nav", { class: "crumbs", "aria-label": "Part of the circuit" });
  #schematic: ShownSchematic = { sheets: [], bodies: [], homes: [] };
  #sheet = 0;
  #svg: SVGSVGElement | null = null;
  /** The robots, of which one is reached by the tab key. */
  #robots: SVGElement[] = [];
  #marked: Marked[] = [];
  #whole: Box = { x: 0, y: 0, width: 1, height: 1 };
  #box: Box = this.#whole;
  #width = 0;
  #height = 0;

  constructor(private readonly swarm: LiveSwarm) {
    this.#tools = element(
      "div",
      { class: "zoom" },
      iconButton("more", "Zoom in", () => this.#zoom(0.8)),
      iconButton("less", "Zoom out", () => this.#zoom(1.25)),
      iconButton("reset", "Show all of the schematic", () => this.#show(this.#whole)),
    );
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
    if (this.#width === 0) {
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
    const hidden = this.#width === 0;
    this.#width = this.host.clientWidth;
    this.#height = this.host.clientHeight;
    if (hidden && this.#width > 0) {
      this.#showFirst();
    }
  }

  /** Opens a sheet, and shows the robots of its part alone. */
  #open(sheet: number): void {
    this.#load(sheet);
    const { homes } = this.#schematic;
    const inside = [...homes.keys()].filter(robot => this.#path(homes[robot] ?? 0).includes(sheet));
    this.swarm.selection.opened.set(sheet === 0 ? null : inside);
    this.draw();
  }

  /** The sheets from the whole to this one. */
  #path(sheet: number): number[] {
    const outer = this.#schematic.sheets[sheet]?.outer ?? null;
    return outer === null ? [sheet] : [...this.#path(outer), sheet];
  }

  #load(sheet: number): void {
    this.#sheet = sheet;
    const { sheets, bodies } = this.#schematic;
    const text = sheets[sheet]?.svg ?? "";
    this.#marked = [];
    this.#robots = [];
    this.#svg = null;
    const parsed = new DOMParser().parseFromString(text, "image/svg+xml").documentElement;
    if (text === "" || !(parsed instanceof SVGSVGElement)) {
      this.host.replaceChildren(element("p", { class: "empty" }, "This circuit has no schematic."));
      return;
    }
    this.#svg = document.importNode(parsed, true);
    const { x, y, width, height } = this.#svg.viewBox.baseVal;
    this.#whole = { x, y, width, height };
    this.#svg.removeAttribute("width");
    this.#svg.removeAttribute("height");
    placeBodies(this.#svg, bodies);
    fill(
      this.#crumbs,
      ...this.#path(sheet).map(at => {
        const { name, about } = sheets[at] ?? { name: "", about: "" };
        return button(name, () => this.#open(at), { title: about, "aria-current": at === sheet ? "page" : null });
      }),
    );
    this.#crumbs.hidden = sheets.length < 2;
    this.host.replaceChildren(this.#svg, this.#crumbs, this.#tools);
    hideLegend(this.#svg);
    this.#mark(this.#svg);
    this.#showFirst();
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
      if (kind === "part") {
        part.setAttribute("tabindex", "0");
        part.setAttribute("role", "button");
        part.setAttribute("aria-label", `open ${part.querySelector("title")?.textContent ?? name}`);
      } else if (kind === "cell") {
        // One robot for the tab key, and arrows for the others: a large circuit is passed as quickly as a small one.
        part.setAttribute("tabindex", this.#robots.length === 0 ? "0" : "-1");
        this.#robots.push(part);
        part.setAttribute("role", "button");
        part.setAttribute("aria-label", part.querySelector("title")?.textContent ?? `robot ${name}`);
      }
    }
  }

  #select(): void {
    const { pointed, followed } = this.swarm.selection;
    for (const { element: marked, source } of this.#marked) {
      marked.classList.toggle("pointed", sameSource(source, pointed.value));
      marked.classList.toggle("followed", "robot" in source && source.robot === followed.value);
    }
  }

  #sourceOf(target: EventTarget | null): BitSource | null {
    // Not by the nearest name: a body within a robot's box has one of its own.
    const found = target instanceof Node ? this.#marked.find(({ element }) => element.contains(target)) : undefined;
    return found?.source ?? null;
  }

  /** The sheet that a box opens, if the target is one. */
  #partOf(target: EventTarget | null): number | null {
    const found = target instanceof Element ? target.closest<SVGElement>('[data-id^="part-"]') : null;
    return found === null ? null : Number(found.dataset["id"]?.slice(5));
  }

  #show(box: Box): void {
    this.#box = box;
    this.#svg?.setAttribute("viewBox", `${box.x} ${box.y} ${box.width} ${box.height}`);
    // Voxels of a pixel or two are not worth drawing.
    this.host.classList.toggle("far", this.#scale() < FAR);
  }

  /** All of it, or as much around the first box or robot as can be read. */
  #showFirst(): void {
    this.#show(this.#whole);
    const svg = this.#svg;
    const find = (kind: string): SVGGraphicsElement | null => svg?.querySelector(`[data-id^="${kind}-"]`) ?? null;
    const first = find("part") ?? find("cell");
    if (svg !== null && first && this.#width > 0 && this.#scale() < UNREADABLE) {
      this.#center(first, READABLE);
    }
  }

  /** Pixels in a unit of the drawing. */
  #scale(): number {
    return Math.min(this.#width / this.#box.width, this.#height / this.#box.height);
  }

  #center(part: SVGGraphicsElement, scale: number): void {
    const { x, y, width, height } = part.getBBox();
    const [across, down] = [this.#width / scale, this.#height / scale];
    this.#show({ x: x + width / 2 - across / 2, y: y + height / 2 - down / 2, width: across, height: down });
  }

  /** Brings the robot that is followed into view. */
  #reveal(robot: number | null): void {
    const home = robot === null ? undefined : this.#schematic.homes[robot];
    if (home !== undefined && home !== this.#sheet) {
      this.#load(home);
      this.#select();
      this.draw();
    }
    const part = this.#svg?.querySelector<SVGGraphicsElement>(`[data-id="cell-${robot}"]`);
    if (part && robot !== null && this.#box !== this.#whole) {
      this.#center(part, Math.max(READABLE, this.#scale()));
    }
  }

  /** Shows `factor` times as much around a place, given as shares of the width and height. */
  #zoom(factor: number, atX = 0.5, atY = 0.5): void {
    const { x, y, width, height } = this.#box;
    const limited = Math.min(2, Math.max(0.02, (width * factor) / this.#whole.width)) * (this.#whole.width / width);
    this.#show({
      x: x + width * (1 - limited) * atX,
      y: y + height * (1 - limited) * atY,
      width: width * limited,
      height: height * limited,
    });
  }

  #listen(): void {
    const { selection } = this.swarm;
    const point = (event: Event): void => selection.point(this.#sourceOf(event.target));
    this.host.addEventListener("mouseover", point);
    this.host.addEventListener("focusin", point);
    this.host.addEventListener("mouseleave", () => selection.point(null));
    this.host.addEventListener("keydown", event => this.#press(event));
    this.host.addEventListener("wheel", event => this.#wheel(event), { passive: false });
    this.host.addEventListener("pointerdown", event => this.#drag(event));
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
    if (step !== undefined) {
      const at = this.#robots.findIndex(robot => robot.tabIndex === 0);
      this.#reach(Math.min(this.#robots.length - 1, Math.max(0, at + step)));
    } else if ((event.key === "Enter" || event.key === " ") && source !== null && "robot" in source) {
      selection.follow(source.robot);
    } else if (event.key === "Escape") {
      selection.followed.set(null);
    } else {
      return;
    }
    event.preventDefault();
  }

  #reach(index: number): void {
    this.#robots.forEach((robot, i) => (robot.tabIndex = i === index ? 0 : -1));
    const robot = this.#robots[index];
    robot?.focus();
    if (robot instanceof SVGGraphicsElement && this.#box !== this.#whole) {
      this.#center(robot, Math.max(READABLE, this.#scale()));
    }
  }

  /** The wheel zooms with Ctrl, as pinching does; without, the page scrolls as everywhere. */
  #wheel(event: WheelEvent): void {
    if (event.ctrlKey) {
      event.preventDefault();
      const box = this.host.getBoundingClientRect();
      const [x, y] = [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
      this.#zoom(Math.exp(event.deltaY / 300), x, y);
    }
  }

  #isTool(target: EventTarget | null): boolean {
    return target instanceof Node && (this.#tools.contains(target) || this.#crumbs.contains(target));
  }

  /** Drags the picture; a press that does not move follows a robot. */
  #drag(start: PointerEvent): void {
    const svg = this.#svg;
    if (svg === null || start.button !== 0 || this.#isTool(start.target)) {
      return;
    }
    const from = this.#box;
    const scale = 1 / (svg.getScreenCTM()?.a ?? 1);
    let moved = false;
    const move = (event: PointerEvent): void => {
      const [x, y] = [event.clientX - start.clientX, event.clientY - start.clientY];
      moved ||= Math.hypot(x, y) > 4;
      if (moved) {
        this.#show({ ...from, x: from.x - x * scale, y: from.y - y * scale });
      }
    };
    const end = (): void => {
      window.removeEventListener("pointermove", move);
      const source = this.#sourceOf(start.target);
      const part = this.#partOf(start.target);
      if (!moved && part !== null) {
        this.#open(part);
      } else if (!moved && source !== null && "robot" in source) {
        this.swarm.selection.follow(source.robot);
      }
    };
    window.addEventListener("pointermove", move);
    window.addEventListener("pointerup", end, { once: true });
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
