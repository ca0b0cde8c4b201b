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

/** A bit with the values from some moments on, up to the last of these; where it is not known, there is nothing. */
export function drawBit(pen: Pen, band: Band, times: number[], value: (time: number) => number | null): void {
  let before: number | null = null;
  for (const [i, time] of times.slice(0, -1).entries()) {
    const now = value(time);
    if (now !== null) {
      drawLevel(pen, band, [time, times[i + 1] ?? time], now, before);
    }
    before = now;
  }
}

/** High is thick and low is thin, so that the values can be told apart without color. */
function drawLevel(
  pen: Pen,
  { high, low, x, colors }: Band,
  [from, to]: [number, number],
  value: number,
  before: number | null,
): void {
  const [left, right] = [x(from), x(to)];
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
  times: number[],
  value: (time: number) => Value,
  text: (value: Value) => string,
): void {
  pen.lineWidth = 1.2;
  for (let begin = 0; begin + 1 < times.length; ) {
    const now = value(times[begin] ?? 0);
    let end = begin + 1;
    while (end + 1 < times.length && value(times[end] ?? 0) === now) {
      end++;
    }
    const [left, right] = [x(times[begin] ?? 0), x(times[end] ?? 0)];
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
