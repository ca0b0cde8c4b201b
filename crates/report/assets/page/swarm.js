"use strict";
// The player of a run's page: a swarm in lanes, in step with its waveform. Everything is in the page; nothing is fetched.

const ROW = 22;

/** Bits as digits, from hexadecimal digits of four of them, the first bit highest. */
const unpacked = (hex, count) => [...hex].map(digit => parseInt(digit, 16).toString(2).padStart(4, "0")).join("").slice(0, count);

class Player {
  constructor(section, swarm, looks) {
    Object.assign(this, { section, swarm, looks, chosen: -1, lanes: [], rows: [], cameras: [] });
    this.stage = section.querySelector(".stage");
    this.wave = section.querySelector(".wave");
    this.note = section.querySelector(".unrecorded");
    this.byCell = new Map(swarm.robots.map((robot, k) => [robot.cell, k]));
    this.clock = new Clock(section, swarm.cycles, () => this.draw());
    this.stage.onclick = event => {
      const k = this.chosen < 0 ? this.lanes[Math.floor(event.offsetY / this.laneHeight())] : this.chosen;
      if (k !== undefined) this.schematic.choose(swarm.robots[k].cell);
    };
    this.wave.onclick = event => {
      const row = this.rows[Math.floor(event.offsetY / ROW)];
      if (row?.sheet !== undefined) return this.schematic.open(row.sheet);
      const left = this.labelWidth();
      this.clock.seek((event.offsetX - left) / (this.wave.clientWidth - left - 8) * this.clock.cycles);
    };
    new ResizeObserver(() => this.draw()).observe(this.stage);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
    const follower = { open: () => this.arrange(), choose: cell => this.follow(cell) };
    this.schematic = { shown: () => [], sheet: 0 };
    this.schematic = new Schematic(section.querySelector(".schematic"), swarm.schematic, swarm.cells, follower);
    this.arrange();
  }

  /** Takes the lanes and rows of the sheet that is shown; parts inside it are rows that open. */
  arrange() {
    const { cells, inputs, outputs, schematic: { sheets } } = this.swarm, shown = this.schematic.shown();
    this.lanes = shown.map(cell => this.byCell.get(cell)).filter(k => k !== undefined);
    const bits = cell => ({ name: cells[cell].net, color: "dim", shift: 1, values: unpacked(cells[cell].bits, this.swarm.cycles) });
    const parts = sheets.map((sheet, at) => ({ sheet: at, name: sheet.name, about: sheet.about, outer: sheet.outer }));
    this.rows = [...inputs, ...shown.map(bits), ...parts.filter(part => part.outer === this.schematic.sheet), ...outputs];
    this.note.hidden = this.lanes.length === shown.length;
    this.note.textContent = shown.length - this.lanes.length + " robots of this sheet were not recorded: there is no room for all.";
    this.draw();
  }

  laneHeight() { return this.chosen < 0 ? 92 : 240; }
  labelWidth() { return Math.min(110, this.wave.clientWidth * .3); }

  /** Follows the robot of a cell alone, if it was recorded; else all of the sheet. */
  follow(cell) {
    this.chosen = this.byCell.get(cell) ?? -1;
    this.cameras = [];
    this.draw();
  }

  draw() {
    const lanes = this.chosen < 0 ? this.lanes : [this.chosen];
    const [pen, width] = fit(this.stage, Math.max(40, lanes.length * this.laneHeight()));
    lanes.forEach((k, lane) => this.drawLane(pen, width, k, lane));
    this.drawWave();
  }

  drawLane(pen, width, k, lane) {
    const robot = this.swarm.robots[k], height = this.laneHeight(), label = Math.min(96, width * .28);
    const frame = this.clock.time * this.swarm.pace, pose = poseAt(robot, frame);
    const scale = Math.min((height - 30) / (robot.size[1] * 1.3), (width - label) / 12);
    const view = { left: label, top: lane * height, width: width - label, ground: (lane + 1) * height - 14, scale };
    view.camera = this.cameras[k] = this.camera(k, middle(pose), view.width / 2 / scale);
    pen.save();
    pen.beginPath();
    pen.rect(label, view.top, view.width, height);
    pen.clip();
    drawGround(pen, view);
    drawPose(pen, robot, pose, view, this.looks);
    pen.restore();
    pen.fillStyle = themed("ink");
    pen.font = "13px system-ui, sans-serif";
    const { net, function: gate } = this.swarm.cells[robot.cell];
    pen.fillText(net + " = " + gate, 4, view.ground - 34, label - 8);
    const cycle = this.clock.cycle();
    if (cycle < this.swarm.cycles) drawStimuli(pen, robot.sensed.map(bits => Number(bits[cycle])), 6, view.ground - 24);
    if (robot.fault !== null && frame >= robot.fault) {
      pen.fillStyle = themed("bad");
      pen.fillText("unstable", 4, view.ground + 4);
    }
  }

  /** Where the camera of a lane stands: it moves only when the robot leaves the middle. */
  camera(k, place, half) {
    const slack = this.chosen < 0 ? half / 2 : half / 4, camera = this.cameras[k] ?? place;
    return Math.min(place + slack, Math.max(place - slack, camera));
  }

  drawWave() {
    const rows = this.rows, height = ROW, bottom = rows.length * height, cycles = this.clock.cycles;
    const [pen, width] = fit(this.wave, bottom + 26), left = this.labelWidth(), span = width - left - 8;
    const x = cycle => left + Math.min(cycle, cycles) / cycles * span;
    const upright = (cycle, color, thick) => {
      pen.strokeStyle = themed(color);
      pen.lineWidth = thick;
      pen.beginPath();
      pen.moveTo(x(cycle), 0);
      pen.lineTo(x(cycle), bottom);
      pen.stroke();
    };
    pen.font = "12px system-ui, sans-serif";
    for (const cycle of this.swarm.marks) upright(cycle, "line", 1);
    rows.forEach((row, r) => this.drawRow(pen, row, r * height, x, left));
    pen.fillStyle = themed("dim");
    pen.textAlign = "center";
    const step = Math.max(1, Math.ceil(cycles / Math.max(2, span / 60)));
    for (let cycle = 0; cycle <= cycles; cycle += step) pen.fillText(String(cycle), x(cycle), bottom + 18);
    pen.textAlign = "start";
    upright(this.clock.time, "bad", 2);
  }

  drawRow(pen, row, top, x, left) {
    const high = top + 5, low = top + 17;
    pen.fillStyle = themed("ink");
    if (row.sheet !== undefined) return pen.fillText("▸ " + row.name + ": " + row.about, 4, low - 1);
    pen.fillText(row.name, 4, low - 1, left - 10);
    pen.strokeStyle = themed(row.color);
    pen.lineWidth = 1.6;
    pen.beginPath();
    if (typeof row.values !== "string") return this.drawBus(pen, row, high, low, x);
    for (let cycle = 0; cycle < row.values.length; cycle++) {
      const y = row.values[cycle] === "1" ? high : low;
      pen.lineTo(x(cycle + row.shift), y);
      pen.lineTo(x(cycle + 1 + row.shift), y);
    }
    pen.stroke();
  }

  /** A bus: a box for each value, with the value in it where there is room. */
  drawBus(pen, row, high, low, x) {
    for (let from = 0, cycle = 1; cycle <= row.values.length; cycle++) {
      if (row.values[cycle] === row.values[from]) continue;
      const left = x(from + row.shift), right = x(cycle + row.shift), value = row.values[from];
      pen.strokeRect(left, high - 2, right - left, low - high + 4);
      pen.fillStyle = themed("ink");
      if (pen.measureText(value).width + 6 < right - left) pen.fillText(value, left + 4, low - 1);
      from = cycle;
    }
  }
}

const data = JSON.parse(document.getElementById("data").textContent);
window.players = data.swarms.map((swarm, i) =>
  new Player(document.getElementById("swarm-" + i), swarm, data.looks));
