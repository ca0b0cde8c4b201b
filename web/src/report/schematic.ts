// The schematic of a circuit, a sheet at a time: boxes that open, a search, a small map, and marked paths.

import { button, element, fill } from "../element";
import { Dragging } from "../live/dragging";
import { drawingOf, pathTo, placeBodies } from "../live/schematic_parts";
import { Viewport, type Box } from "../live/viewport";
import { Observable } from "../observable";
import type { SchematicPages } from "../protocol";
import type { Cell } from "./data";
import { Nets, type Reach } from "./nets";
import { describe, part } from "./shown";

/** The least scale at which a sheet can be read, and a step of the zoom. */
const READABLE = 0.7;
const STEP = 4 / 3;
/** The most parts, robots and inputs that a search finds. */
const MOST = [6, 12, 6];
/** The most nets that are named together. */
const NAMED = 60;
const HINT = "Point at a robot to see what it is; choose it to mark its wires. A box with two edges opens.";

/** A group of the drawing that can be chosen or opened. */
interface Item {
  group: SVGGElement;
  kind: "cell" | "part" | "net" | "nets";
  /** The rest of its identity. */
  name: string;
}

export class Schematic {
  /** The sheet that is shown. */
  readonly sheet = new Observable(0);
  /** The robot that is chosen. */
  readonly robot = new Observable<number | null>(null);
  readonly #nets: Nets;
  /** The nets that are chosen. */
  #chosen: string[] = [];
  #items: Item[] = [];
  #svg: SVGSVGElement | null = null;
  #whole: Box = { x: 0, y: 0, width: 1, height: 1 };
  readonly #view = new Viewport();
  /** Whether the reader has not zoomed or moved the sheet yet. */
  #isFirst = true;
  readonly #place: HTMLElement;
  readonly #map: HTMLElement;
  #frame: SVGElement | null = null;
  readonly #panel: HTMLElement;
  readonly #results: HTMLElement;
  readonly #reach: HTMLSelectElement;

  constructor(
    private readonly root: HTMLElement,
    private readonly sheets: SchematicPages,
    private readonly cells: Cell[],
  ) {
    this.#nets = new Nets(cells);
    this.#place = part(root, ".sheet");
    this.#map = part(root, ".map-of-sheet");
    this.#panel = part(root.parentElement ?? root, ".robot");
    this.#results = part(root, ".results");
    this.#reach = part(root, ".reach");
    this.#listen();
    this.#measure();
    this.open(0);
    this.#describe(null);
  }

  /** The robots that are drawn on the sheet that is shown. */
  shown(): number[] {
    return this.#items.flatMap(({ kind, name }) => (kind === "cell" ? [Number(name)] : []));
  }

  open(sheet: number): void {
    const { sheets, bodies } = this.sheets;
    const svg = drawingOf(sheets[sheet]);
    if (svg === null) {
      return;
    }
    this.#svg = svg;
    const { x, y, width, height } = svg.viewBox.baseVal;
    this.#whole = { x, y, width, height };
    ["width", "height"].forEach(name => svg.removeAttribute(name));
    placeBodies(svg, bodies);
    this.#frame = document.createElementNS(svg.namespaceURI, "rect") as SVGElement;
    this.#frame.setAttribute("class", "frame");
    const small = svg.cloneNode(true) as SVGSVGElement;
    small.append(this.#frame);
    fill(this.#map, small);
    fill(this.#place, svg);
    this.#items = [...svg.querySelectorAll<SVGGElement>("g[data-id]")].flatMap(group => {
      const [, kind, name] = /^(cell|part|nets?)-(.*)$/s.exec(group.dataset["id"] ?? "") ?? [];
      return kind === undefined ? [] : [{ group, kind: kind as Item["kind"], name: name ?? "" }];
    });
    for (const { group, kind } of this.#items) {
      if (kind === "cell" || kind === "part") {
        group.setAttribute("tabindex", "0");
        group.setAttribute("role", "button");
        group.setAttribute("aria-label", group.querySelector("title")?.textContent ?? "");
      }
    }
    fill(
      part(this.root, ".crumbs"),
      ...pathTo(sheets, sheet).map(at =>
        button(sheets[at]?.name ?? "", () => this.open(at), { "aria-current": at === sheet ? "page" : null }),
      ),
      element("span", { class: "dim" }, sheets[sheet]?.about),
    );
    this.sheet.set(sheet);
    this.#begin();
    this.#mark();
  }

  /** Chooses a robot, or none if it is chosen already. */
  choose(robot: number): void {
    this.#choose(this.robot.value === robot ? [] : [this.cells[robot]?.net ?? ""]);
  }

  #choose(nets: string[]): void {
    this.#chosen = nets;
    this.robot.set((nets.length === 1 ? this.#nets.driver(nets[0] ?? "") : undefined) ?? null);
    this.#mark();
    this.#describe(null);
  }

  #listen(): void {
    const point = (event: Event): void => this.#describe(this.#itemOf(event.target));
    this.#place.addEventListener("mouseover", point);
    this.#place.addEventListener("focusin", point);
    this.#place.addEventListener("mouseleave", () => this.#describe(null));
    this.#place.addEventListener("focusout", () => this.#describe(null));
    this.#place.addEventListener("keydown", event => this.#press(event));
    const move = (by: [number, number], factor: number, at: [number, number]): void => {
      this.#view.move(...by);
      this.#zoom(factor, ...at);
    };
    new Dragging(this.#place, move, target => this.#act(this.#itemOf(target)));
    this.#map.addEventListener("pointerdown", event => {
      const { x, y, width, height } = this.#whole;
      const across = x + (event.offsetX / this.#map.clientWidth) * width;
      this.#center({ x: across, y: y + (event.offsetY / this.#map.clientHeight) * height, width: 0, height: 0 });
    });
    const search = part<HTMLInputElement>(this.root, ".search");
    search.addEventListener("input", () => this.#find(search.value.trim().toLowerCase()));
    this.#reach.addEventListener("change", () => this.#mark());
    part(this.root, ".nearer").addEventListener("click", () => this.#zoom(STEP));
    part(this.root, ".farther").addEventListener("click", () => this.#zoom(1 / STEP));
    part(this.root, ".whole").addEventListener("click", () => this.#fit());
    new ResizeObserver(() => {
      this.#measure();
      if (this.#isFirst) {
        this.#begin();
      } else {
        this.#show();
      }
    }).observe(this.#place);
  }

  #press(event: KeyboardEvent): void {
    const outer = this.sheets.sheets[this.sheet.value]?.outer ?? null;
    if (event.key === "Escape" && outer !== null) {
      this.open(outer);
    } else if (event.key === "Enter" || event.key === " ") {
      event.preventDefault();
      this.#act(this.#itemOf(event.target));
    }
  }

  #itemOf(target: EventTarget | null): Item | null {
    return (target instanceof Node ? this.#items.find(({ group }) => group.contains(target)) : undefined) ?? null;
  }

  /** Opens a part, and chooses anything else. */
  #act(item: Item | null): void {
    if (item?.kind === "part") {
      this.open(Number(item.name));
    } else if (item?.kind === "cell") {
      this.choose(Number(item.name));
    } else if (item !== null) {
      this.#choose(this.#netsOf(item));
    }
  }

  /** The nets that a group of wires is. */
  #netsOf({ kind, name }: Item): string[] {
    return kind === "nets" ? (this.sheets.sheets[this.sheet.value]?.bundles[Number(name)] ?? []) : [name];
  }

  #mark(): void {
    const { sheets, homes } = this.sheets;
    const nets = this.#nets.reached(this.#chosen, this.#reach.value as Reach);
    const robots = new Set([...nets].map(net => this.#nets.driver(net)));
    const around = new Set(
      [...robots].flatMap(robot => (robot === undefined ? [] : pathTo(sheets, homes[robot] ?? 0))),
    );
    for (const item of this.#items) {
      const { group, kind, name } = item;
      const marks = {
        cell: () => robots.has(Number(name)),
        part: () => around.has(Number(name)),
        net: () => nets.has(name),
        nets: () => this.#netsOf(item).some(net => nets.has(net)),
      };
      group.classList.toggle("marked", marks[kind]());
      if (kind === "cell") {
        const isChosen = this.robot.value === Number(name);
        group.classList.toggle("chosen", isChosen);
        group.setAttribute("aria-pressed", String(isChosen));
      }
    }
  }

  /** Says what is known of a robot or a part, else of what is chosen. */
  #describe(item: Item | null): void {
    const sheet = item?.kind === "part" ? this.sheets.sheets[Number(item.name)] : undefined;
    const cell = this.cells[item?.kind === "cell" ? Number(item.name) : (this.robot.value ?? -1)];
    if (sheet !== undefined) {
      describe(this.#panel, sheet.name, [["part", sheet.about]]);
    } else if (cell !== undefined) {
      describe(this.#panel, `${cell.net} = ${cell.function}`, cell.about);
    } else if (this.#chosen.length > 0) {
      const names = this.#chosen.slice(0, NAMED).join(", ");
      describe(this.#panel, `${this.#chosen.length} nets`, [["nets", names]]);
    } else {
      this.#panel.textContent = HINT;
    }
  }

  /** Lists the parts, robots and nets whose name has this text, in small letters. */
  #find(text: string): void {
    const { sheets, homes } = this.sheets;
    const has = (name: string): boolean => text !== "" && name.toLowerCase().includes(text);
    const entry = (label: string, act: () => void): HTMLElement => {
      const chosen = button(label, () => {
        fill(this.#results);
        act();
      });
      return element("li", {}, chosen);
    };
    const where = (robot: number): string => {
      const names = pathTo(sheets, homes[robot] ?? 0).map(at => sheets[at]?.name);
      return names.length > 1 ? `, in ${names.slice(1).join(" / ")}` : "";
    };
    const parts = sheets.flatMap(({ name, about }, at) =>
      at > 0 && has(name) ? [(): HTMLElement => entry(`${name}: ${about}`, () => this.open(at))] : [],
    );
    const robots = this.cells.flatMap(({ net, function: gate }, robot) =>
      has(net) ? [(): HTMLElement => entry(`${net} = ${gate}${where(robot)}`, () => this.#reveal(robot))] : [],
    );
    const choose = (net: string): void => {
      this.open(0);
      this.#choose([net]);
    };
    const inputs = this.#nets
      .inputs()
      .flatMap(net => (has(net) ? [(): HTMLElement => entry(`input ${net}`, () => choose(net))] : []));
    const found = [parts, robots, inputs].flatMap((entries, kind) => entries.slice(0, MOST[kind]));
    const isNothing = text !== "" && found.length === 0;
    fill(this.#results, ...found.map(make => make()), isNothing && element("li", {}, "Nothing has this name."));
  }

  /** Opens the sheet of a robot, and chooses it. */
  #reveal(robot: number): void {
    this.open(this.sheets.homes[robot] ?? 0);
    if (this.robot.value !== robot) {
      this.choose(robot);
    }
    const own = this.#items.find(({ kind, name }) => kind === "cell" && Number(name) === robot);
    if (own !== undefined && !this.#view.isWhole) {
      this.#center(own.group.getBBox());
    }
  }

  /** The whole sheet, or its left edge if the whole could not be read. */
  #begin(): void {
    this.#fit();
    const { x, y, width, height } = this.#whole;
    if (this.#view.scale < READABLE) {
      const [across, down] = [this.#view.width / READABLE, this.#view.height / READABLE];
      this.#view.center({ x, y, width: Math.min(width, across), height: Math.max(height, down) }, READABLE);
      this.#show();
    }
    this.#isFirst = true;
  }

  #measure(): void {
    this.#view.width = this.#place.clientWidth;
    this.#view.height = this.#place.clientHeight;
  }

  #fit(): void {
    this.#view.fit(this.#whole, () => ({ left: 0, right: 0, top: 0, bottom: 0 }));
    this.#show();
  }

  #center(box: Box): void {
    this.#view.center(box);
    this.#show();
  }

  #zoom(factor: number, x?: number, y?: number): void {
    this.#view.zoom(factor, x, y);
    this.#show();
  }

  #show(): void {
    const { x, y, width, height } = this.#view.box;
    this.#isFirst = false;
    this.#svg?.setAttribute("viewBox", `${x} ${y} ${width} ${height}`);
    this.#map.hidden = this.#view.isWhole;
    Object.entries({ x, y, width, height }).forEach(([name, value]) => this.#frame?.setAttribute(name, String(value)));
  }
}
