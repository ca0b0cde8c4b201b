"use strict";
// The archive of an evolution page: a map for each behavior, whose niches open their elites and play their gaits.

class Archive {
  constructor(data) {
    this.data = data;
    this.chosen = -1;
    this.maps = document.querySelector(".maps");
    this.panel = document.querySelector(".robot");
    this.player = document.querySelector(".player");
    this.stage = document.querySelector(".stage");
    this.axes = [...document.querySelectorAll(".axis")];
    this.axes.forEach(axis => { axis.onchange = () => this.drawMaps(); });
    this.clock = new Clock(this.player, data.patterns.length * data.cycles, () => this.draw());
    this.maps.onkeydown = event => this.walk(event);
    new ResizeObserver(() => this.draw()).observe(this.stage);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
    this.drawMaps();
    this.open(data.first);
  }

  /** The fittest elite of each niche of two axes, by behavior, column and row. */
  collect(x, y) {
    const best = new Map();
    this.data.elites.forEach((elite, i) => {
      const key = elite.behavior + " " + (elite.niche[x] ?? 0) + " " + (elite.niche[y] ?? 0);
      if (!best.has(key) || this.data.elites[best.get(key)].fitness[0] < elite.fitness[0]) best.set(key, i);
    });
    return best;
  }

  drawMaps() {
    const [x, y] = this.axes.map(axis => Number(axis.value)), best = this.collect(x, y);
    this.maps.replaceChildren(...this.data.behaviors.map(behavior => this.map(behavior, x, y, best)));
  }

  map(behavior, x, y, best) {
    const map = document.createElement("div"), grid = document.createElement("div"), title = document.createElement("h3");
    const columns = this.data.axes[x]?.bins ?? 1, rows = this.data.axes[y]?.bins ?? 1;
    const gate = document.createElement("span");
    gate.textContent = behavior.function;
    title.append(behavior.word + " ", gate);
    grid.className = "niches";
    grid.style.gridTemplateColumns = "repeat(" + columns + ", 1fr)";
    let found = 0;
    for (let row = rows - 1; row >= 0; row--) {
      for (let column = 0; column < columns; column++) {
        const i = best.get(behavior.word + " " + column + " " + row);
        found += i !== undefined;
        grid.append(this.niche(i));
      }
    }
    map.className = found ? "map" : "map none";
    map.append(title, grid);
    return map;
  }

  niche(i) {
    if (i === undefined) return Object.assign(document.createElement("span"), { className: "niche" });
    const elite = this.data.elites[i], button = document.createElement("button");
    button.type = "button";
    button.className = i === this.chosen ? "niche chosen" : "niche";
    button.style.background = elite.color;
    button.dataset.elite = i;
    button.setAttribute("aria-label", elite.behavior + ", " + elite.about[0].join(" "));
    button.title = elite.about[0].join(" ");
    button.onclick = () => {
      this.open(i);
      this.stage.scrollIntoView({ block: "nearest" });
    };
    return button;
  }

  /** Arrow keys go from niche to niche. */
  walk(event) {
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    const niches = [...this.maps.querySelectorAll("button")], at = niches.indexOf(document.activeElement);
    niches[Math.max(0, Math.min(niches.length - 1, at + step))]?.focus();
  }

  /** Shows an elite and plays its gait. */
  open(i) {
    const elite = this.data.elites[i];
    if (!elite) return;
    this.chosen = i;
    for (const button of this.maps.querySelectorAll("button")) button.classList.toggle("chosen", Number(button.dataset.elite) === i);
    describe(this.panel, elite.behavior + " " + elite.function, elite.about);
    this.player.hidden = !elite.frames;
    document.querySelector(".missing").hidden = Boolean(elite.frames);
    this.camera = undefined;
    this.clock.seek(0);
    if (elite.frames && !this.clock.playing && this.ready) this.clock.toggle();
    this.ready = true;
  }

  draw() {
    const elite = this.data.elites[this.chosen];
    if (!elite || !elite.frames) return;
    const [pen, width] = fit(this.stage, 220), pose = poseAt(elite, this.clock.time * this.data.pace);
    const ground = 206, scale = Math.min(165 / (elite.size[1] * 1.3), width / (elite.size[0] * 2));
    const place = middle(pose), slack = width / scale / 6;
    this.camera = Math.min(place + slack, Math.max(place - slack, this.camera ?? place));
    const view = { left: 0, top: 0, width, ground, scale, camera: this.camera };
    drawGround(pen, view);
    drawPose(pen, elite, pose, view, this.data.looks);
    const shown = Math.min(this.data.patterns.length - 1, Math.floor(this.clock.time / this.data.cycles));
    const image = this.data.images[shown];
    if (image) {
      drawImage(pen, image, 8, 8);
      return;
    }
    const pattern = this.data.patterns[shown];
    drawStimuli(pen, [...pattern].map(Number), 8, 8);
    pen.fillStyle = themed("ink");
    pen.font = "13px system-ui, sans-serif";
    pen.fillText("stimuli " + pattern, 12 + 22 * pattern.length, 20);
  }
}

// An image with black for 1, its longer side 64 pixels long.
function drawImage(pen, rows, left, top) {
  const side = 64 / Math.max(rows.length, rows[0].length);
  rows.forEach((row, y) => row.forEach((value, x) => {
    const gray = Math.round(255 - 229 * value);
    pen.fillStyle = `rgb(${gray}, ${gray}, ${gray})`;
    pen.fillRect(left + x * side, top + y * side, side + 0.5, side + 0.5);
  }));
}

window.archive = new Archive(JSON.parse(document.getElementById("data").textContent));
