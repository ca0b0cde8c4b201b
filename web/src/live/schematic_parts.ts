// Parts of the schematic's drawing that are added or hidden after it has come.

import type { ShownSchematic } from "../protocol";

/** The drawing of the whole with the bodies of its robots, as a file. */
export function wholeOf({ sheets, bodies }: ShownSchematic): string {
  const svg = new DOMParser().parseFromString(sheets[0]?.svg ?? "", "image/svg+xml");
  if (svg.documentElement instanceof SVGSVGElement) {
    placeBodies(svg.documentElement, bodies);
  }
  return new XMLSerializer().serializeToString(svg);
}

/** Puts the bodies of the robots into their places. */
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

/** A place for the number of a thread, below the function of a robot. */
export function threadNumber(cell: SVGElement): Element | null {
  const frame = cell.querySelector("rect");
  if (frame === null) {
    return null;
  }
  const [x, y] = ["x", "y"].map(name => Number(frame.getAttribute(name)));
  const number = document.createElementNS(cell.namespaceURI, "text");
  number.setAttribute("class", "thread");
  number.setAttribute("x", String((x ?? 0) + 6));
  number.setAttribute("y", String((y ?? 0) + 30));
  cell.append(number);
  return number;
}

/** Colors show values here, so the legend of the critical path would mislead. */
export function hideLegend(svg: SVGSVGElement): void {
  for (const text of svg.querySelectorAll(":scope > text")) {
    if (text.textContent === "critical path") {
      text.previousElementSibling?.remove();
      text.remove();
    }
  }
}
