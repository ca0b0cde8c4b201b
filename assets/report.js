"use strict";
// Plays the robots of each test in step with their waveform. Everything is in the page; nothing is fetched.
const colors = () => { const s = getComputedStyle(document.documentElement); return name => s.getPropertyValue("--" + name).trim(); };
const decode = text => { const raw = atob(text), bytes = new Uint8Array(raw.length); for (let i = 0; i < raw.length; i++) bytes[i] = raw.charCodeAt(i);
  return new Int16Array(bytes.buffer); };

function fit(canvas, height) {
  const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth || 320;
  canvas.style.height = height + "px"; canvas.width = Math.round(width * ratio); canvas.height = Math.round(height * ratio);
  const g = canvas.getContext("2d"); g.setTransform(ratio, 0, 0, ratio, 0, 0); g.clearRect(0, 0, width, height); return [g, width];
}

function poseAt(robot, time) {
  // Between two frames points go straight; a film has few frames a cycle.
  const size = robot.points * 2, count = robot.data.length / size, at = Math.min(time, count - 1), a = Math.floor(at), b = Math.min(a + 1, count - 1), part = at - a;
  const out = new Float64Array(size);
  for (let i = 0; i < size; i++) out[i] = (robot.data[a * size + i] * (1 - part) + robot.data[b * size + i] * part) / 100;
  return out;
}

function drawPose(g, robot, points, x, y, scale, palette) {
  for (const [p, q, r, s, code] of robot.voxels) {
    g.beginPath(); [p, q, r, s].forEach((n, i) => g[i ? "lineTo" : "moveTo"](x + points[2 * n] * scale, y - points[2 * n + 1] * scale)); g.closePath();
    g.fillStyle = palette[code - 1] || "#888"; g.fill(); g.strokeStyle = "rgba(0,0,0,.55)"; g.lineWidth = .8; g.stroke();
  }
}

const middle = points => { let x = 0; for (let i = 0; i < points.length; i += 2) x += points[i]; return points.length ? 2 * x / points.length : 0; };

class Player {
  constructor(section, data, palette) {
    this.section = section; this.data = data; this.palette = palette; this.time = 0; this.playing = false; this.chosen = -1;
    for (const robot of data.robots) robot.data = decode(robot.frames);
    const find = name => section.querySelector("." + name);
    this.stage = find("stage"); this.wave = find("wave"); this.button = find("play"); this.slider = find("scrub"); this.speed = find("speed"); this.clock = find("clock"); this.panel = find("robot");
    this.cameras = data.robots.map(robot => middle(poseAt(robot, 0)));
    this.button.onclick = () => this.toggle();
    this.slider.max = this.cycles(); this.slider.oninput = () => { this.seek(Number(this.slider.value)); };
    this.wave.onclick = event => { const left = this.left(); this.seek((event.offsetX - left) / (this.wave.clientWidth - left - 8) * this.cycles()); };
    section.querySelectorAll('[data-id^="cell-"]').forEach(cell => {
      const k = Number(cell.dataset.id.slice(5)); cell.tabIndex = 0; cell.setAttribute("role", "button");
      cell.setAttribute("aria-label", cell.querySelector("title").textContent);
      cell.onmouseenter = () => this.show(k); cell.onmouseleave = () => this.show(this.chosen);
      cell.onclick = () => this.choose(k);
      cell.onkeydown = event => { if (event.key === "Enter" || event.key === " ") { event.preventDefault(); this.choose(k); } };
    });
    this.stage.onclick = event => { if (this.chosen < 0) this.choose(Math.floor(event.offsetY / this.lane())); else this.choose(this.chosen); };
    new ResizeObserver(() => this.draw()).observe(this.stage);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
    this.show(-1); this.draw();
  }
  cycles() { return this.data.cycles.length; }
  left() { return Math.min(110, this.wave.clientWidth * .3); }
  lane() { return this.chosen < 0 ? 92 : 240; }
  toggle() { this.playing = !this.playing; if (this.playing && this.time >= this.cycles()) this.time = 0; this.button.textContent = this.playing ? "Pause" : "Play";
    this.last = undefined; if (this.playing) requestAnimationFrame(now => this.tick(now)); }
  tick(now) {
    if (!this.playing) return;
    if (this.last !== undefined) this.time += (now - this.last) / 1000 * Number(this.speed.value);
    this.last = now;
    if (this.time >= this.cycles()) { this.time = this.cycles(); this.toggle(); } else requestAnimationFrame(next => this.tick(next));
    this.draw();
  }
  seek(cycle) { this.time = Math.max(0, Math.min(this.cycles(), cycle)); this.cameras = []; this.draw(); }
  choose(k) {
    if (!this.data.robots[k]) return;
    this.chosen = this.chosen === k ? -1 : k;
    this.section.querySelectorAll('[data-id^="cell-"]').forEach(cell => cell.classList.toggle("chosen", cell.dataset.id === "cell-" + this.chosen));
    this.show(this.chosen); this.draw();
  }
  show(k) {
    const robot = this.data.robots[k], panel = this.panel; panel.replaceChildren();
    if (!robot) { panel.textContent = "Point at a cell to see its robot; choose it to follow the robot."; return; }
    const name = document.createElement("strong"); name.textContent = robot.net + " = " + robot.function; panel.append(name);
    const list = document.createElement("dl");
    for (const [key, value] of robot.about) { const dt = document.createElement("dt"), dd = document.createElement("dd"); dt.textContent = key; dd.textContent = value; list.append(dt, dd); }
    panel.append(list);
  }
  draw() { this.drawStage(); this.drawWave(); this.slider.value = this.time; this.clock.textContent = "cycle " + Math.min(this.cycles(), Math.floor(this.time) + 1) + " of " + this.cycles(); }
  drawStage() {
    const color = colors(), lanes = this.chosen < 0 ? this.data.robots.map((_, k) => k) : [this.chosen], height = this.lane();
    const [g, width] = fit(this.stage, Math.max(40, lanes.length * height)); const label = Math.min(96, width * .28);
    lanes.forEach((k, lane) => {
      const robot = this.data.robots[k], points = poseAt(robot, this.time * this.data.pace), com = middle(points);
      const scale = Math.min((height - 30) / (robot.size[1] * 1.3), (width - label) / 12), ground = (lane + 1) * height - 14, half = (width - label) / 2 / scale;
      const slack = this.chosen < 0 ? half / 2 : half / 4, camera = this.cameras[k] === undefined ? com : Math.min(com + slack, Math.max(com - slack, this.cameras[k]));
      this.cameras[k] = camera;
      const x = label + half * scale - camera * scale;
      g.save(); g.beginPath(); g.rect(label, lane * height, width - label, height); g.clip();
      g.fillStyle = color("sky"); g.fillRect(label, lane * height, width - label, height); g.fillStyle = color("ground"); g.fillRect(label, ground, width - label, 9);
      g.fillStyle = "#fff9"; for (let v = Math.ceil(camera - half); v <= camera + half; v++) g.fillRect(x + v * scale, ground, 1, v % 5 ? 3 : 8);
      drawPose(g, robot, points, x, ground, scale, this.palette); g.restore();
      const cycle = this.data.cycles[Math.min(Math.floor(this.time), this.cycles() - 1)];
      g.fillStyle = color("ink"); g.font = "13px system-ui, sans-serif"; g.fillText(robot.net, 4, ground - 34, label - 8);
      if (cycle) ["s1", "s2"].forEach((name, i) => { g.strokeStyle = g.fillStyle = color(name); g.lineWidth = 2; g.strokeRect(6 + i * 22, ground - 24, 14, 14); if (cycle.sensed[k][i]) g.fillRect(6 + i * 22, ground - 24, 14, 14); });
      if (robot.fault !== null && this.time * this.data.pace >= robot.fault) { g.fillStyle = color("bad"); g.fillText("unstable", 4, ground + 4); }
    });
  }
  drawWave() {
    const color = colors(), rows = this.data.waves, height = 22, [g, width] = fit(this.wave, rows.length * height + 26), left = this.left(), span = width - left - 8, x = cycle => left + cycle / this.cycles() * span;
    g.font = "12px system-ui, sans-serif"; g.lineWidth = 1.6;
    rows.forEach((row, r) => {
      const high = r * height + 5, low = r * height + height - 5; g.fillStyle = color("ink"); g.fillText(row.name, 4, low - 1, left - 10);
      g.strokeStyle = g.fillStyle = color(row.color); g.beginPath();
      row.bits.forEach((bit, c) => { const y = bit ? high : low; g.lineTo(x(c + row.shift), y); g.lineTo(Math.min(x(c + 1 + row.shift), x(this.cycles())), y); }); g.stroke();
    });
    g.strokeStyle = color("line"); g.fillStyle = color("dim"); g.lineWidth = 1;
    for (const cycle of this.data.marks) { g.beginPath(); g.moveTo(x(cycle), 0); g.lineTo(x(cycle), rows.length * height); g.stroke(); }
    const step = Math.max(1, Math.ceil(this.cycles() / Math.max(2, span / 60))); for (let c = 0; c <= this.cycles(); c += step) g.fillText(String(c), x(c) - 4, rows.length * height + 18);
    g.strokeStyle = color("bad"); g.lineWidth = 2; g.beginPath(); g.moveTo(x(this.time), 0); g.lineTo(x(this.time), rows.length * height); g.stroke();
  }
}

const data = JSON.parse(document.getElementById("data").textContent);
window.players = data.tests.map((test, i) => test.robots.length ? new Player(document.getElementById("test-" + i), test, data.palette) : null);
