// Inputs, outputs and registers over time, and the robots on demand.

import { button } from "../element";
import { recall, remember } from "../memory";
import { toNumber } from "../ports";
import type { StimulusSource } from "../protocol";
import { sameSource } from "../selection";
import { colors } from "../colors";
import { enlargement } from "../theme";
import { AXIS, Diagram } from "./diagram";
import { drawBit, drawBus } from "./levels";
import { numberFormat, numberText } from "./numbers";
import type { Pen } from "./pane";
import { waveRows, type WaveRow } from "./rows";
import type { LiveSwarm } from "./swarm";
import type { Timeline } from "./timeline";

export class Waveform extends Diagram {
  readonly toggle = button("Robots", () => this.#switch(), {
    "data-do": "wave-robots",
    title: "Show the bit of each robot, too",
  });
  #rows: WaveRow[] = [];
  #robots = recall<boolean>("wave-robots") ?? false;

  constructor(swarm: LiveSwarm, timeline: Timeline, changed: () => void) {
    super(swarm, timeline, "waveform", "Waveforms of inputs, outputs and registers", changed);
    for (const changing of [swarm.definition, swarm.selection.opened, swarm.selection.followed]) {
      changing.on(() => this.#list());
    }
    numberFormat.on(changed);
    this.toggle.setAttribute("aria-pressed", String(this.#robots));
  }

  #switch(): void {
    this.#robots = !this.#robots;
    remember("wave-robots", this.#robots);
    this.toggle.setAttribute("aria-pressed", String(this.#robots));
    this.#list();
  }

  #list(): void {
    const { definition, selection } = this.swarm;
    const { followed, opened } = selection;
    const asked = followed.value === null ? [] : [followed.value];
    const robots = this.#robots ? "all" : asked;
    this.#rows = definition.value === null ? [] : waveRows(definition.value, { opened: opened.value, robots });
    this.changed();
  }

  draw(): void {
    if (!this.pane.visible || this.swarm.definition.value === null) {
      return;
    }
    const height = this.#rowHeight();
    const pen = this.pane.begin(this.#rows.length * height + AXIS * enlargement.value);
    const bottom = this.pane.height - AXIS * enlargement.value;
    const first = Math.floor(this.pane.scrolled / height);
    const end = Math.min(this.#rows.length, Math.ceil((this.pane.scrolled + bottom) / height));
    this.drawAxis(pen, 0, bottom);
    pen.save();
    pen.beginPath();
    pen.rect(0, 0, this.pane.width, bottom);
    pen.clip();
    for (let row = first; row < end; row++) {
      this.#drawRow(pen, this.#rows[row] as WaveRow, row * height - this.pane.scrolled, height);
    }
    pen.restore();
  }

  protected point(_x: number, y: number): void {
    const row = this.#rows[Math.floor((y + this.pane.scrolled) / this.#rowHeight())];
    this.swarm.selection.point(row?.sources[0] ?? null);
  }

  #rowHeight(): number {
    const room = (this.pane.height - AXIS * enlargement.value) / Math.max(1, this.#rows.length);
    return Math.max(15, Math.min(24, room)) * Math.max(1, enlargement.value * 0.85);
  }

  #drawRow(pen: Pen, row: WaveRow, top: number, height: number): void {
    const pointed = row.sources.some(source => sameSource(source, this.swarm.selection.pointed.value));
    if (pointed) {
      pen.fillStyle = colors.value.highlight;
      pen.fillRect(0, top, this.pane.width, height);
    }
    pen.textAlign = "left";
    pen.textBaseline = "middle";
    pen.font = `${row.group === "robot" ? "" : "600 "}${12 * enlargement.value}px ${colors.value.font}`;
    pen.fillStyle = row.group === "robot" ? colors.value.dim : colors.value.ink;
    const name = { input: `› ${row.name}`, output: `${row.name} ›`, register: row.name, robot: row.name }[row.group];
    pen.fillText(name, 6, top + height / 2, this.label - 12);
    pen.save();
    pen.beginPath();
    const end = this.swarm.running.value ? this.x(this.swarm.playback.time, this.range()[0]) : this.pane.width;
    pen.rect(this.label, top, end - this.label, height);
    pen.clip();
    this.#drawSignal(pen, row, [top + 3, top + height - 3]);
    pen.restore();
  }

  #drawSignal(pen: Pen, { sources, valued }: WaveRow, [high, low]: [number, number]): void {
    const [start, from, to] = this.#cycles();
    const times = [from];
    for (let cycle = from; cycle <= to; cycle++) {
      times.push(...this.swarm.edges(sources, cycle), cycle + 1);
    }
    const x = (cycle: number): number => this.x(cycle - 1, start);
    const band = { high, low, x, left: this.label, colors: colors.value };
    if (sources.length === 1) {
      drawBit(pen, band, times, time => this.swarm.valueAt(sources[0] as StimulusSource, time));
      return;
    }
    const value = (time: number): bigint => toNumber(sources.map(source => this.swarm.valueAt(source, time) ?? 0));
    pen.font = `${11 * enlargement.value}px ${colors.value.font}`;
    drawBus(pen, band, times, value, number => numberText(number, valued));
  }

  #cycles(): [number, number, number] {
    const [start, end] = this.range();
    const { log, playback, running } = this.swarm;
    const last = running.value ? playback.cycle : log.last;
    return [start, Math.max(log.first + 1, Math.floor(start) + 1), Math.min(last, Math.ceil(end))];
  }
}
