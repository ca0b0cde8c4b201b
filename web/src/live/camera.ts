// Where the camera of a lane stands, and which lanes are in view.

import type { Outline } from "./playback";

export function middleOf(outline: Outline): number {
  let sum = 0;
  for (let i = 0; i < outline.length; i += 2) {
    sum += outline[i] ?? 0;
  }
  return outline.length === 0 ? 0 : (2 * sum) / outline.length;
}

/** The camera moves only when the robot leaves the middle part of its lane, so that one sees it walk. */
export function followWithSlack(camera: number | undefined, place: number, slack: number): number {
  return Math.min(place + slack, Math.max(place - slack, camera ?? place));
}

/** Lanes in columns, from the top left, row by row. */
export class LaneGrid {
  constructor(
    readonly count: number,
    readonly columns: number,
    readonly width: number,
    readonly laneHeight: number,
  ) {}

  get height(): number {
    return Math.ceil(this.count / this.columns) * this.laneHeight;
  }

  get laneWidth(): number {
    return this.width / this.columns;
  }

  left(lane: number): number {
    return (lane % this.columns) * this.laneWidth;
  }

  top(lane: number): number {
    return Math.floor(lane / this.columns) * this.laneHeight;
  }

  at(x: number, y: number): number | null {
    const column = Math.min(this.columns - 1, Math.max(0, Math.floor(x / this.laneWidth)));
    const lane = Math.floor(y / this.laneHeight) * this.columns + column;
    return y >= 0 && lane < this.count ? lane : null;
  }

  /** The lanes that are at least partly between `top` and `bottom`. */
  between(top: number, bottom: number): number[] {
    const first = Math.max(0, Math.floor(top / this.laneHeight)) * this.columns;
    const end = Math.min(this.count, Math.ceil(bottom / this.laneHeight) * this.columns);
    return Array.from({ length: Math.max(0, end - first) }, (_, i) => first + i);
  }
}
