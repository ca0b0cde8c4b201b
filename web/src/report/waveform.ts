// The inputs, the robots and parts of a sheet, and the outputs over all cycles.

import { colors, styled } from "../colors";
import { drawBit, drawBus } from "../live/levels";
import { CanvasPane, type Pen } from "../live/pane";
import type { Clock } from "./clock";
import type { RecordedSwarm, WaveRow } from "../protocol";

/** The heights of a row, and of the numbers below all. */
const ROW = 22;
const AXIS = 26;
/** Pixels for the number of a cycle. */
const NUMBER = 60;

/** A row of a part, which opens it. */
interface PartRow {
  sheet: number;
  name: string;
}

export class Waveform {
  readonly pane: CanvasPane;
  #rows: (WaveRow | PartRow)[] = [];

  constructor(
    private readonly swarm: RecordedSwarm,
    private readonly clock: Clock,
    open: (sheet: number) => void,
  ) {
    const label = "Inputs, bits of the sheet's robots, parts and outputs over the cycles";
    this.pane = new CanvasPane("wave", label, () => clock.wake());
    this.pane.host.addEventListener("click", event => {
      const box = this.pane.host.getBoundingClientRect();
      const row = this.#rows[Math.floor((event.clientY - box.top + this.pane.scrolled) / ROW)];
      if (row !== undefined && "sheet" in row) {
        open(row.sheet);
      } else {
        clock.seek(((event.clientX - box.left - this.#label) / this.#span) * clock.cycles);
      }
    });
  }

  /** Takes the rows of a sheet with these robots. */
  arrange(sheet: number, robots: number[]): void {
    const { cells, inputs, outputs, cycles, schematic } = this.swarm;
    const bits = (robot: number): WaveRow => {
      const { net = "", bits = "" } = cells[robot] ?? {};
      return { name: net, color: "dim", shift: 1, values: unpacked(bits, cycles) };
    };
    const parts = schematic.sheets.flatMap(({ name, about, outer }, at) =>
      outer === sheet ? [{ sheet: at, name: `▸ ${name}: ${about}` }] : [],
    );
    this.#rows = [...inputs, ...robots.map(bits), ...parts, ...outputs];
    this.pane.host.style.height = `${this.#height}px`;
  }

  draw(): void {
    if (!this.pane.visible) {
      return;
    }
    const pen = this.pane.begin(this.#height);
    const { scrolled, width, height } = this.pane;
    const bottom = height - AXIS;
    this.#drawUpright(pen, bottom, this.swarm.marks, colors.value.line, 1);
    pen.save();
    pen.beginPath();
    pen.rect(0, 0, width, bottom);
    pen.clip();
    const first = Math.floor(scrolled / ROW);
    const last = Math.ceil((scrolled + bottom) / ROW);
    this.#rows.slice(first, last).forEach((row, i) => this.#drawRow(pen, row, (first + i) * ROW - scrolled));
    pen.restore();
    pen.font = `12px ${colors.value.font}`;
    pen.fillStyle = colors.value.dim;
    pen.textAlign = "center";
    pen.textBaseline = "alphabetic";
    const step = Math.max(1, Math.ceil(this.clock.cycles / Math.max(2, this.#span / NUMBER)));
    for (let cycle = 0; cycle <= this.clock.cycles; cycle += step) {
      pen.fillText(String(cycle), this.#x(cycle), bottom + 18);
    }
    this.#drawUpright(pen, bottom, [this.clock.time], colors.value.bad, 2);
  }

  get #height(): number {
    return this.#rows.length * ROW + AXIS;
  }

  get #label(): number {
    return Math.min(110, this.pane.width * 0.3);
  }

  get #span(): number {
    return Math.max(1, this.pane.width - this.#label - 8);
  }

  #x(cycle: number): number {
    return this.#label + (Math.min(cycle, this.clock.cycles) / Math.max(1, this.clock.cycles)) * this.#span;
  }

  #drawUpright(pen: Pen, bottom: number, cycles: number[], color: string, width: number): void {
    pen.fillStyle = color;
    for (const cycle of cycles) {
      pen.fillRect(this.#x(cycle) - width / 2, 0, width, bottom);
    }
  }

  #drawRow(pen: Pen, row: WaveRow | PartRow, top: number): void {
    const [high, low] = [top + 4, top + ROW - 4];
    pen.font = `12px ${colors.value.font}`;
    pen.textAlign = "left";
    pen.textBaseline = "middle";
    pen.fillStyle = colors.value.ink;
    if ("sheet" in row) {
      pen.fillText(row.name, 4, top + ROW / 2);
      return;
    }
    pen.fillText(row.name, 4, top + ROW / 2, this.#label - 10);
    const color = styled(row.color);
    const x = (cycle: number): number => this.#x(cycle + row.shift);
    const band = { high, low, x, left: this.#label, colors: { ...colors.value, one: color, zero: color } };
    const { values } = row;
    const cycles = Array.from({ length: values.length + 1 }, (_, cycle) => cycle);
    if (typeof values === "string") {
      drawBit(pen, band, cycles, cycle => Number(values[cycle]));
    } else {
      drawBus(
        pen,
        band,
        cycles,
        cycle => values[cycle] ?? "",
        value => value,
      );
    }
  }
}

/** Bits as digits, from hexadecimal digits of four of them, the first one highest. */
function unpacked(hex: string, count: number): string {
  return [...hex]
    .map(digit => parseInt(digit, 16).toString(2).padStart(4, "0"))
    .join("")
    .slice(0, count);
}
