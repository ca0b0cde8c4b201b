import assert from "node:assert/strict";
import { test } from "node:test";

import { drawBit, drawBus } from "../src/live/levels";

/** A pen that notes what it draws: kind or color, left, right, top and bottom, or a text and its place. */
class Noting {
  fillStyle = "";
  strokeStyle = "";
  notes: unknown[][] = [];

  fillRect(left: number, top: number, width: number, height: number): void {
    this.notes.push([this.fillStyle, left, left + width, top, top + height]);
  }

  strokeRect(left: number, top: number, width: number, height: number): void {
    this.notes.push([this.strokeStyle, left, left + width, top, top + height]);
  }

  fillText(text: string, x: number): void {
    this.notes.push([text, x]);
  }

  measureText(text: string): { width: number } {
    return { width: 10 * text.length };
  }

  get pen(): CanvasRenderingContext2D {
    return this as unknown as CanvasRenderingContext2D;
  }
}

const BAND = {
  high: 2,
  low: 12,
  x: (cycle: number) => 100 + 20 * cycle,
  left: 110,
  colors: { one: "one", zero: "zero", dim: "dim", ink: "ink" },
};

test("high is thick and tinted, low is thin, and what is unknown is left out", () => {
  const noting = new Noting();
  drawBit(noting.pen, BAND, [0, 1, 2, 3, 4], cycle => [1, 0, null, 0][cycle] ?? null);
  assert.deepEqual(noting.notes, [
    ["one", 100, 120, 2, 12],
    ["one", 100, 120, 2, 5],
    ["zero", 120, 140, 10.5, 12],
    ["dim", 119.5, 120.7, 2, 12],
    ["zero", 160, 180, 10.5, 12],
  ]);
});

test("a bus has a box for each value, and its text where there is room", () => {
  const noting = new Noting();
  const values = [7n, 7n, 0n, 12n];
  drawBus(noting.pen, BAND, [0, 1, 2, 3, 4], cycle => values[cycle] ?? 0n, String);
  assert.deepEqual(noting.notes, [
    ["one", 100.5, 139.5, 2, 12],
    ["7", 114],
    ["zero", 140.5, 159.5, 2, 12],
    ["0", 144],
    ["one", 160.5, 179.5, 2, 12],
  ]);
});
