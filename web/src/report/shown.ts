// What all pages do.

import { refreshColors, styled } from "../colors";
import { element, factList, fill } from "../element";
import { drawStimulus } from "../live/drawing";
import type { Pen } from "../live/pane";

/** The side of the square of a stimulus, and its way to the next one. */
const SQUARE = 15;
const STEP = 22;

/** The data of a page, whose pictures follow the theme of the system from now on. */
export function readPage<Data>(): Data {
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", refreshColors);
  return JSON.parse(document.getElementById("data")?.textContent ?? "") as Data;
}

/** An element that the program has written. */
export function part<Part extends Element = HTMLElement>(root: ParentNode, selector: string): Part {
  return root.querySelector(selector) as Part;
}

/** A name and what is known of it. */
export function describe(panel: HTMLElement, title: string, facts: [string, string][]): void {
  fill(panel, element("strong", {}, title), factList(facts));
}

/** The square of a stimulus, from 0, in the color that it has in all pictures; `x` is the place of the first one. */
export function drawPresence(pen: Pen, stimulus: number, value: number, x: number, y: number): void {
  const color = styled(`s${stimulus + 1}`);
  drawStimulus(pen, value, x + stimulus * STEP, y, SQUARE, { one: color, dim: color });
}
