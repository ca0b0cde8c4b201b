// Bits as levels and numbers as boxes, as waveforms show them.

import type { Colors } from "../colors";
import type { Pen } from "./pane";

/** Where a row of a waveform is on the canvas, and what its colors are. */
export interface Band {
  high: number;
  low: number;
  x: (cycle: number) => number;
  left: number;
  colors: Pick<Colors, "one" | "zero" | "dim" | "ink">;
}

/** A bit from a cycle to another one; where it is not known, there is nothing. */
export function drawBit(
  pen: Pen,
  band: Band,
  [from, to]: [number, number],
  value: (cycle: number) => number | null,
): void {
  let before: number | null = null;
  for (let cycle = from; cycle <= to; cycle++) {
    const now = value(cycle);
    if (now !== null) {
      drawLevel(pen, band, cycle, now, before);
    }
    before = now;
  }
}

/** High is thick and low is thin, so that the values can be told apart without color. */
function drawLevel(
  pen: Pen,
  { high, low, x, colors }: Band,
  cycle: number,
  value: number,
  before: number | null,
): void {
  const [left, right] = [x(cycle), x(cycle + 1)];
  pen.fillStyle = value === 1 ? colors.one : colors.zero;
  if (value === 1) {
    pen.globalAlpha = 0.18;
    pen.fillRect(left, high, right - left, low - high);
    pen.globalAlpha = 1;
    pen.fillRect(left, high, right - left, 3);
  } else {
    pen.fillRect(left, low - 1.5, right - left, 1.5);
  }
  if (before !== null && before !== value) {
    pen.fillStyle = colors.dim;
    pen.fillRect(left - 0.5, high, 1.2, low - high);
  }
}

/** A box for each value, with its text in it where there is room. */
export function drawBus<Value extends bigint | string>(
  pen: Pen,
  { high, low, x, left: least, colors }: Band,
  [from, to]: [number, number],
  value: (cycle: number) => Value,
  text: (value: Value) => string,
): void {
  pen.lineWidth = 1.2;
  for (let begin = from; begin <= to; ) {
    const now = value(begin);
    let end = begin + 1;
    while (end <= to && value(end) === now) {
      end++;
    }
    const [left, right] = [x(begin), x(end)];
    pen.strokeStyle = now === 0n ? colors.zero : colors.one;
    pen.strokeRect(left + 0.5, high, right - left - 1, low - high);
    const inner = Math.max(left, least);
    const written = text(now);
    if (pen.measureText(written).width + 8 < right - inner) {
      pen.fillStyle = colors.ink;
      pen.fillText(written, inner + 4, (high + low) / 2 + 0.5);
    }
    begin = end;
  }
}
