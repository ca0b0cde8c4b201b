// Parts of the schematic's drawing that are added or hidden after it has come.

import type { SchematicPages, SheetPage } from "../protocol";
import type { Box } from "./viewport";

/** The drawing of the whole with the bodies of its robots, as a file. */
export function wholeOf({ sheets, bodies }: SchematicPages): string {
  const svg = new DOMParser().parseFromString(sheets[0]?.svg ?? "", "image/svg+xml");
  if (svg.documentElement instanceof SVGSVGElement) {
    placeBodies(svg.documentElement, bodies);
  }
  return new XMLSerializer().serializeToString(svg);
}

/** The drawing of a sheet for the page, without the bodies of its robots; null if there is none. */
export function drawingOf(sheet: SheetPage | undefined): SVGSVGElement | null {
  const drawn = new DOMParser().parseFromString(sheet?.svg ?? "", "image/svg+xml").documentElement;
  return drawn instanceof SVGSVGElement ? document.importNode(drawn, true) : null;
}

export function pathTo(sheets: SheetPage[], sheet: number): number[] {
  const outer = sheets[sheet]?.outer ?? null;
  return outer === null ? [sheet] : [...pathTo(sheets, outer), sheet];
}

/** Makes a drawing wider by a factor, with its heights as they are. */
export function widen(svg: SVGSVGElement, factor: number): void {
  const scale = (parts: string, ...names: string[]): void =>
    svg.querySelectorAll(parts).forEach(part => {
      names.forEach(name => part.setAttribute(name, String(factor * Number(part.getAttribute(name)))));
    });
  scale("line", "x1", "x2");
  scale("circle", "cx");
  scale("rect", "x", "width");
  for (const line of svg.querySelectorAll("polyline")) {
    const wider = (x: string): string => String(factor * Number(x));
    line.setAttribute("points", (line.getAttribute("points") ?? "").replace(/[-\d.]+(?=,)/g, wider));
  }
}

export function placeBodies(svg: SVGSVGElement, bodies: string[]): void {
  const drawn = bodies.map(text => new DOMParser().parseFromString(text, "image/svg+xml").documentElement);
  for (const place of svg.querySelectorAll<SVGElement>('[data-id^="body-"]')) {
    const body = drawn[Number(place.dataset["id"]?.slice(5))];
    place.append(
      ...[...(body?.children ?? [])].filter(part => part.nodeName !== "title").map(part => part.cloneNode(true)),
    );
  }
}

/** A wide line of the thread's color below each line of a net, whose own color is its value. */
export function addHalo(net: SVGElement): void {
  const halo = document.createElementNS(net.namespaceURI, "g");
  halo.setAttribute("class", "halo");
  halo.append(...[...net.querySelectorAll("polyline, line, path")].map(line => line.cloneNode()));
  net.prepend(halo);
}

export function threadNumber(cell: SVGElement): Element {
  const number = document.createElementNS(cell.namespaceURI, "text");
  number.setAttribute("class", "thread");
  cell.append(number);
  return number;
}

/**
 * Leaves the boxes and wires of a drawing for paper, and says where they are: the page has a ground, titles and a legend
 * of its own. Who hears the page comes from robot to robot, which are no picture.
 */
export function leaveDrawing(svg: SVGSVGElement): Box {
  ["width", "height"].forEach(name => svg.removeAttribute(name));
  svg.setAttribute("role", "group");
  svg.querySelector(":scope > title")?.remove();
  const { width, height } = svg.viewBox.baseVal;
  const ground = svg.querySelector(":scope > rect");
  const title = svg.querySelector(":scope > text");
  for (const text of svg.querySelectorAll(":scope > text")) {
    const samples = { "critical path": 1, "a part with robots": 2 }[text.textContent ?? ""] ?? 0;
    for (let i = 0; i < samples; i++) {
      text.previousElementSibling?.remove();
    }
    if (samples > 0) {
      text.remove();
    }
  }
  ground?.remove();
  title?.remove();
  const boxes = [...svg.querySelectorAll("rect")].map(rect =>
    ["x", "y", "width", "height"].map(name => Number(rect.getAttribute(name))),
  );
  const points = [...svg.querySelectorAll("polyline")].flatMap(line =>
    (line.getAttribute("points") ?? "").split(" ").map(point => point.split(",").map(Number)),
  );
  const xs = [...boxes.flatMap(([x = 0, , wide = 0]) => [x, x + wide]), ...points.map(([x = 0]) => x)];
  const ys = [...boxes.flatMap(([, y = 0, , high = 0]) => [y, y + high]), ...points.map(([, y = 0]) => y)];
  if (xs.length === 0) {
    return { x: 0, y: 0, width, height };
  }
  const [left, top] = [Math.min(...xs), Math.min(...ys)];
  return { x: left, y: top, width: Math.max(1, Math.max(...xs) - left), height: Math.max(1, Math.max(...ys) - top) };
}
