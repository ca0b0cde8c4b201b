"use strict";
// The schematic of a circuit, a sheet at a time: boxes that open, a search, a small map, and marked paths.

/** The least scale at which a sheet can be read. */
const READABLE = .7;
const HINT = "Point at a robot to see what it is; choose it to mark its wires. A box with two edges opens.";
const named = (name, values, ...children) => {
  const made = Object.assign(document.createElement(name), values);
  made.append(...children);
  return made;
};

class Schematic {
  /** `cells` are the robots with their nets and those that they read; `follower` is told what is shown and chosen. */
  constructor(root, { sheets, bodies, homes }, cells, follower = {}) {
    Object.assign(this, { root, sheets, homes, cells, follower, chosen: null, sheet: 0 });
    this.panel = root.parentElement.querySelector(".robot");
    this.place = root.querySelector(".sheet");
    this.map = root.querySelector(".map-of-sheet");
    this.bodies = bodies.map(text => new DOMParser().parseFromString(text, "image/svg+xml").documentElement);
    this.byNet = new Map(cells.map((cell, k) => [cell.net, k]));
    this.readers = new Map();
    cells.forEach((cell, k) => cell.reads.forEach(net => this.readers.set(net, [...(this.readers.get(net) ?? []), k])));
    this.search = root.querySelector(".search");
    this.results = root.querySelector(".results");
    this.search.oninput = () => this.find(this.search.value.trim());
    this.reach = root.querySelector(".reach");
    this.reach.onchange = () => this.mark();
    root.querySelector(".nearer").onclick = () => this.zoom(.75);
    root.querySelector(".farther").onclick = () => this.zoom(1 / .75);
    root.querySelector(".whole").onclick = () => this.show(this.all);
    this.place.onpointerdown = event => this.drag(event);
    this.place.addEventListener("wheel", event => this.wheel(event), { passive: false });
    this.place.onkeydown = event => { if (event.key === "Escape") this.leave(); };
    this.map.onpointerdown = event => this.center((event.offsetX / this.map.clientWidth) * this.all.width,
      (event.offsetY / this.map.clientHeight) * this.all.height);
    new ResizeObserver(() => { if (this.box) this.show(this.box); }).observe(this.place);
    this.open(0);
    this.describeChosen();
  }

  /** The sheets from the whole to this one. */
  path(sheet) {
    const outer = this.sheets[sheet].outer;
    return outer === null ? [sheet] : [...this.path(outer), sheet];
  }

  /** The box on a sheet in which another sheet is, or -1. */
  boxOn(sheet, other) {
    const path = this.path(other), at = path.indexOf(sheet);
    return at < 0 ? -1 : path[at + 1] ?? -1;
  }

  /** The robots that are drawn on the sheet that is shown. */
  shown() { return this.parts("cell").map(([, name]) => Number(name)); }

  /** Opens a sheet. */
  open(sheet) {
    this.sheet = sheet;
    this.svg = document.importNode(new DOMParser().parseFromString(this.sheets[sheet].svg, "image/svg+xml").documentElement, true);
    const { x, y, width, height } = this.svg.viewBox.baseVal;
    this.all = { x, y, width, height };
    ["width", "height"].forEach(name => this.svg.removeAttribute(name));
    for (const [place, name] of this.parts("body")) {
      place.append(...[...this.bodies[Number(name)].children].filter(part => part.nodeName !== "title").map(part => part.cloneNode(true)));
    }
    for (const [cell, name] of this.parts("cell")) this.bind(cell, () => this.choose(Number(name)), () => this.describe(Number(name)));
    for (const [part, name] of this.parts("part")) this.bind(part, () => this.open(Number(name)), () => this.describePart(Number(name)));
    for (const kind of ["net", "nets"]) {
      for (const [net] of this.parts(kind)) net.onclick = () => { if (!this.moved) this.chooseNet(this.netsOf(net)); };
    }
    this.place.replaceChildren(this.svg);
    const small = this.svg.cloneNode(true);
    this.frame = document.createElementNS(this.svg.namespaceURI, "rect");
    this.frame.setAttribute("class", "frame");
    small.append(this.frame);
    this.map.replaceChildren(small);
    const crumbs = this.path(sheet).map(at => named("button", { type: "button", textContent: this.sheets[at].name, onclick: () => this.open(at) }));
    crumbs.at(-1).setAttribute("aria-current", "page");
    this.root.querySelector(".crumbs").replaceChildren(...crumbs, named("span", { className: "dim", textContent: this.sheets[sheet].about }));
    this.begin();
    this.mark();
    this.follower.open?.(sheet);
  }

  leave() {
    const outer = this.sheets[this.sheet].outer;
    if (outer !== null) this.open(outer);
  }

  /** The groups of one kind, each with the rest of its identity. */
  parts(kind) {
    return [...this.svg.querySelectorAll('[data-id^="' + kind + '-"]')].map(part => [part, part.dataset.id.slice(kind.length + 1)]);
  }

  bind(part, act, describe) {
    part.setAttribute("tabindex", "0");
    part.setAttribute("role", "button");
    part.setAttribute("aria-label", part.querySelector("title").textContent);
    part.onmouseenter = part.onfocus = describe;
    part.onmouseleave = part.onblur = () => this.describeChosen();
    part.onclick = () => { if (!this.moved) act(); };
    part.onkeydown = event => {
      if (event.key !== "Enter" && event.key !== " ") return;
      event.preventDefault();
      act();
    };
  }

  /** The names of the nets that a group of wires is. */
  netsOf(group) {
    const [, several, name] = /^net(s?)-(.*)$/s.exec(group.dataset.id);
    return several ? this.sheets[this.sheet].bundles[Number(name)] : [name];
  }

  /** Chooses a robot, or none if it is chosen already. */
  choose(k) {
    this.chosen = this.chosen?.robot === k ? null : { robot: k, nets: [this.cells[k].net] };
    this.chose();
  }

  chooseNet(nets) {
    this.chosen = { robot: nets.length === 1 ? this.byNet.get(nets[0]) : undefined, nets };
    this.chose();
  }

  chose() {
    this.mark();
    this.describeChosen();
    this.follower.choose?.(this.chosen?.robot ?? -1);
  }

  /** The nets that are marked: those that the chosen ones read, or all before or after them. */
  marked() {
    if (!this.chosen) return new Set();
    const found = new Set(this.chosen.nets), open = [...this.chosen.nets], reach = this.reach.value;
    const before = net => this.cells[this.byNet.get(net)]?.reads ?? [];
    const after = net => (this.readers.get(net) ?? []).map(k => this.cells[k].net);
    if (reach === "wires") before(this.chosen.robot === undefined ? "" : this.cells[this.chosen.robot].net).forEach(net => found.add(net));
    while (reach !== "wires" && open.length) {
      for (const net of (reach === "before" ? before : after)(open.pop())) {
        if (!found.has(net)) open.push(net);
        found.add(net);
      }
    }
    return found;
  }

  mark() {
    const marked = this.marked(), sheets = new Set();
    for (const net of marked) {
      const k = this.byNet.get(net);
      if (k !== undefined) sheets.add(this.boxOn(this.sheet, this.homes[k]));
    }
    for (const [cell, name] of this.parts("cell")) {
      cell.classList.toggle("chosen", this.chosen?.robot === Number(name));
      cell.classList.toggle("marked", marked.has(this.cells[Number(name)].net));
      cell.setAttribute("aria-pressed", String(this.chosen?.robot === Number(name)));
    }
    for (const [part, name] of this.parts("part")) part.classList.toggle("marked", sheets.has(Number(name)));
    for (const kind of ["net", "nets"]) {
      for (const [group] of this.parts(kind)) group.classList.toggle("marked", this.netsOf(group).some(net => marked.has(net)));
    }
  }

  describe(k) { describe(this.panel, this.cells[k].net + " = " + this.cells[k].function, this.cells[k].about); }
  describePart(sheet) { describe(this.panel, this.sheets[sheet].name, [["part", this.sheets[sheet].about]]); }

  describeChosen() {
    if (this.chosen === null) this.panel.textContent = HINT;
    else if (this.chosen.robot !== undefined) this.describe(this.chosen.robot);
    else describe(this.panel, this.chosen.nets.length + " nets", [["nets", this.chosen.nets.slice(0, 60).join(", ")]]);
  }

  /** Lists the parts, robots and nets whose name has this text. */
  find(text) {
    const wanted = text.toLowerCase(), found = [];
    const add = (label, act) => found.push(named("li", {}, named("button", { type: "button", textContent: label, onclick: () => { this.results.replaceChildren(); act(); } })));
    if (wanted) {
      this.sheets.forEach((sheet, at) => { if (at && found.length < 6 && sheet.name.toLowerCase().includes(wanted)) add(sheet.name + ": " + sheet.about, () => this.open(at)); });
      const where = k => this.path(this.homes[k]).slice(1).map(at => this.sheets[at].name).join(" / ");
      this.cells.forEach((cell, k) => {
        if (found.length < 14 && cell.net.toLowerCase().includes(wanted)) add(cell.net + " = " + cell.function + (where(k) ? ", in " + where(k) : ""), () => this.reveal(k));
      });
      for (const net of this.readers.keys()) {
        if (found.length < 18 && !this.byNet.has(net) && net.toLowerCase().includes(wanted)) add("input " + net, () => { this.open(0); this.chooseNet([net]); });
      }
      if (!found.length) found.push(named("li", { textContent: "Nothing has this name." }));
    }
    this.results.replaceChildren(...found);
  }

  /** Opens the sheet of a robot, and chooses it. */
  reveal(k) {
    this.open(this.homes[k]);
    if (this.chosen?.robot !== k) this.choose(k);
    const box = this.svg.querySelector('[data-id="cell-' + k + '"]').getBBox();
    if (this.box !== this.all) this.center(box.x + box.width / 2, box.y + box.height / 2);
  }

  /** Pixels in a unit of the drawing. */
  scale(box = this.box) { return Math.min(this.place.clientWidth / box.width, this.place.clientHeight / box.height); }

  /** The whole sheet, or its beginning if the whole could not be read. */
  begin() {
    const { clientWidth, clientHeight } = this.place, scale = Math.min(1, this.scale(this.all));
    if (!clientWidth || scale >= READABLE) return this.show(this.all);
    const [width, height] = [clientWidth / READABLE, clientHeight / READABLE];
    this.show({ x: 0, y: Math.max(0, (this.all.height - height) / 2), width, height });
  }

  show(box) {
    this.box = box;
    this.svg.setAttribute("viewBox", [box.x, box.y, box.width, box.height].join(" "));
    this.map.hidden = box === this.all;
    for (const name of ["x", "y", "width", "height"]) this.frame.setAttribute(name, box[name]);
  }

  center(x, y) { this.show({ ...this.box, x: x - this.box.width / 2, y: y - this.box.height / 2 }); }

  zoom(factor, atX = .5, atY = .5) {
    const { x, y, width, height } = this.box, limited = Math.min(1.5 * this.all.width, Math.max(150, width * factor)) / width;
    this.show({ x: x + width * (1 - limited) * atX, y: y + height * (1 - limited) * atY, width: width * limited, height: height * limited });
  }

  /** The wheel zooms with Ctrl, as pinching does; without, the page scrolls. */
  wheel(event) {
    if (!event.ctrlKey) return;
    event.preventDefault();
    const box = this.place.getBoundingClientRect();
    this.zoom(Math.exp(event.deltaY / 300), (event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height);
  }

  drag(start) {
    const from = this.box, scale = this.scale();
    this.moved = false;
    const move = event => {
      const [x, y] = [event.clientX - start.clientX, event.clientY - start.clientY];
      this.moved ||= Math.hypot(x, y) > 4;
      if (this.moved) this.show({ ...from, x: from.x - x / scale, y: from.y - y / scale });
    };
    window.addEventListener("pointermove", move);
    window.addEventListener("pointerup", () => window.removeEventListener("pointermove", move), { once: true });
  }
}
