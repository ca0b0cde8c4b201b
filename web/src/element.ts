// Elements of the page, made in one expression.

export type Child = Node | string | null | undefined | false;

type Handlers = { [Name in keyof HTMLElementEventMap as `on${Name}`]?: (event: HTMLElementEventMap[Name]) => void };

export type Attributes = Handlers & { [name: string]: unknown };

/**
 * Makes an element. A function is a listener. `true` gives an empty attribute, `false` and `null` none; attributes of
 * data and accessibility have the words `true` and `false`.
 */
export function element<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[Tag] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") {
      made.addEventListener(name.slice(2), value as EventListener);
    } else if (typeof value === "boolean" && /^(aria|data)-/.test(name)) {
      made.setAttribute(name, String(value));
    } else if (value !== false && value !== null && value !== undefined) {
      made.setAttribute(name, value === true ? "" : String(value));
    }
  }
  append(made, children);
  return made;
}

export function append(parent: Node, children: Child[]): void {
  for (const child of children) {
    if (child !== null && child !== undefined && child !== false) {
      parent.appendChild(typeof child === "string" ? document.createTextNode(child) : child);
    }
  }
}

export function factList(facts: [string, string][]): HTMLElement {
  return element("dl", {}, ...facts.flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, value)]));
}

export function fill(parent: Element, ...children: Child[]): void {
  parent.replaceChildren();
  append(parent, children);
}

export function button(
  label: string,
  onclick: (event: MouseEvent) => void,
  attributes: Attributes = {},
): HTMLButtonElement {
  return element("button", { type: "button", onclick, ...attributes }, label);
}

/** A button with a drawn sign; `label` is what it is called. */
export function iconButton(
  icon: IconName,
  label: string,
  onclick: (event: MouseEvent) => void,
  attributes: Attributes = {},
): HTMLButtonElement {
  const made = element("button", {
    type: "button",
    class: "icon",
    title: label,
    "aria-label": label,
    onclick,
    ...attributes,
  });
  made.append(drawIcon(icon));
  return made;
}

export function changeIcon(made: HTMLButtonElement, icon: IconName, label: string): void {
  made.replaceChildren(drawIcon(icon));
  made.title = label;
  made.setAttribute("aria-label", label);
}

const ICONS = {
  play: "M6 4l13 8-13 8z",
  pause: "M6 4h4v16H6zM14 4h4v16h-4z",
  step: "M5 4l9 8-9 8zM16 4h3v16h-3z",
  reset: "M5 4h3v16H5zM19 4l-9 8 9 8z",
  undo: "M9 4L3 10l6 6v-4h6a3 3 0 010 6h-4v3h4a6 6 0 000-12H9z",
  redo: "M15 4l6 6-6 6v-4H9a3 3 0 000 6h4v3H9A6 6 0 019 8h6z",
  more: "M11 5h2v6h6v2h-6v6h-2v-6H5v-2h6z",
  less: "M5 11h14v2H5z",
  fill: "M14 4h6v6h-2V7.4l-4.3 4.3-1.4-1.4L16.6 6H14zM10 20H4v-6h2v2.6l4.3-4.3 1.4 1.4L7.4 18H10z",
  whole: "M4 4h16v16H4zM6 6v12h12V6zM8 8h8v8H8z",
  rename: "M4 20v-4L15 5l4 4L8 20zM16.5 3.5l2-1.5 4 4-1.5 2z",
  close: "M6.4 5L12 10.6 17.6 5 19 6.4 13.4 12l5.6 5.6-1.4 1.4-5.6-5.6L6.4 19 5 17.6l5.6-5.6L5 6.4z",
  theme: "M12 3a9 9 0 100 18zm0 0v18a9 9 0 000-18zM12 5a7 7 0 010 14z",
  projector: "M3 5h18v11H3zM5 7v7h14V7zM8 19h8v2H8z",
  take: "M11 4h2v8h4l-5 5-5-5h4zM5 18h14v2H5z",
  crowd:
    "M4 4h4v4H4zM10 4h4v4h-4zM16 4h4v4h-4zM4 10h4v4H4zM10 10h4v4h-4zM16 10h4v4h-4zM4 16h4v4H4zM10 16h4v4h-4zM16 16h4v4h-4z",
} as const;

export type IconName = keyof typeof ICONS;

function drawIcon(name: IconName): SVGElement {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", "0 0 24 24");
  svg.setAttribute("aria-hidden", "true");
  const path = document.createElementNS(svg.namespaceURI, "path");
  path.setAttribute("d", ICONS[name]);
  path.setAttribute("fill-rule", "evenodd");
  svg.append(path);
  return svg as SVGElement;
}

/** The whole number in a field, at least 1; `otherwise` if there is none. */
export function countIn({ value }: HTMLInputElement, otherwise = 1): number {
  return Math.max(1, Math.round(Number(value)) || otherwise);
}
