// What is read can be read, and what is told apart by color can be told apart, in both themes and without green cones.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

import { THREAD_COLORS } from "../src/live/waves";

type Rgb = [number, number, number];

const TOKENS = readFileSync("src/style/tokens.css", "utf8");
/** The colors of materials, which the program sends. */
const SCHEME = readFileSync("../crates/report/src/color.rs", "utf8");

/** WCAG AA: of text, and of what is not text. */
const TEXT = 4.5;
const SHAPE = 3;
/** The least difference of colors that carry meaning; from about 2 on it can be seen side by side. */
const APART = 15;

/** The colors of a theme; those that the dark one does not name are those of the light one. */
function themeOf(selectors: string[]): Map<string, string> {
  const blocks = selectors.map(selector => TOKENS.slice(TOKENS.indexOf(selector)).split("}")[0] ?? "");
  const entries = blocks.flatMap(block => [...block.matchAll(/--([\w-]+): (#[0-9a-f]+);/g)]);
  return new Map(entries.map(([, name = "", color = ""]) => [name, color]));
}

const THEMES = { light: themeOf([":root {"]), dark: themeOf([":root {", ':root[data-theme="dark"] {']) };

const MATERIALS = [
  ...(/const SAFE[^=]*= \[(.*?)\];/s.exec(SCHEME)?.[1] ?? "").matchAll(/new\((\d+), (\d+), (\d+)\)/g),
].map(([, r, g, b]): Rgb => [Number(r), Number(g), Number(b)]);

/** A color as it is seen on another one. */
function seen(color: string, below: string): Rgb {
  const [r, g, b, alpha = 255] = (color.slice(1).match(/../g) ?? []).map(digits => parseInt(digits, 16));
  const under = below === color ? [0, 0, 0] : seen(below, below);
  return [r, g, b].map((part = 0, i) => (part * alpha + (under[i] ?? 0) * (255 - alpha)) / 255) as Rgb;
}

function linear(color: Rgb): Rgb {
  return color.map(part => {
    const share = part / 255;
    return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
  }) as Rgb;
}

function luminance(color: Rgb): number {
  const [r, g, b] = linear(color);
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

function contrast(a: Rgb, b: Rgb): number {
  const [high = 0, low = 0] = [luminance(a), luminance(b)].sort((x, y) => y - x);
  return (high + 0.05) / (low + 0.05);
}

/** Linear light as someone without green cones sees it (Machado, Oliveira and Fernandes, 2009). */
function withoutGreenCones([r, g, b]: Rgb): Rgb {
  return [
    0.367322 * r + 0.860646 * g - 0.227968 * b,
    0.280085 * r + 0.672501 * g + 0.047413 * b,
    -0.01182 * r + 0.04294 * g + 0.968881 * b,
  ].map(part => Math.min(1, Math.max(0, part))) as Rgb;
}

/** Linear light in the coordinates of CIELAB, in which distances are differences that are seen. */
function lab([r, g, b]: Rgb): Rgb {
  const root = (part: number): number => (part > 0.008856 ? Math.cbrt(part) : 7.787 * part + 16 / 116);
  const x = root((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505);
  const y = root(0.2126 * r + 0.7152 * g + 0.0722 * b);
  const z = root((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089);
  return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
}

function difference(a: Rgb, b: Rgb): number {
  const [first, second] = [a, b].map(color => lab(withoutGreenCones(linear(color)))) as [Rgb, Rgb];
  return Math.hypot(...first.map((part, i) => part - (second[i] ?? 0)));
}

/** Checks pairs of a color and what it is on, as `name on name`. */
function check(pairs: string[], least: number): void {
  for (const [theme, colors] of Object.entries(THEMES)) {
    for (const pair of pairs) {
      const [color, below] = pair.split(" on ").map(name => colors.get(name) ?? assert.fail(name)) as [string, string];
      const found = contrast(seen(color, below), seen(below, below));
      assert.ok(found >= least, `${pair} (${theme}): ${found.toFixed(2)}, expected ${least}`);
    }
  }
}

const THREADS = Array.from({ length: THREAD_COLORS }, (_, i) => `thread-${i + 1}`);

const on = (names: string, grounds: string): string[] =>
  names.split(" ").flatMap(name => grounds.split(" ").map(ground => `${name} on ${ground}`));

test("text can be read", () => {
  check(on("ink dim", "paper panel raised highlight notice"), TEXT);
  check(on("accent one zero good bad", "paper panel raised"), TEXT);
  check(["on-accent on accent", "on-one on one", "tick on ground"], TEXT);
  check(
    THREADS.map(name => `on-thread on ${name}`),
    TEXT,
  );
});

test("the program can be read, on the active line, too", () => {
  const syntax = [...THEMES.light.keys()].filter(name => name.startsWith("syntax-"));
  check(on(syntax.join(" "), "paper highlight"), TEXT);
  const gutters = /"\.cm-gutters": \{[^}]*color: "var\(--([\w-]+)\)"/.exec(
    readFileSync("src/editor/editor.ts", "utf8"),
  );
  check(on(gutters?.[1] ?? "", "paper highlight"), TEXT);
});

test("the numbers of threads can be read in the schematic, and their strips can be seen", () => {
  check(on(THREADS.join(" "), "paper panel"), TEXT);
});

test("fields, switches and lamps can be seen", () => {
  check(on("strong-line one zero accent", "paper panel raised"), SHAPE);
});

test("every voxel has an edge or a color that stands out, on the stage and in the designer", () => {
  for (const [theme, colors] of Object.entries(THEMES)) {
    for (const ground of ["sky", "paper"].map(name => colors.get(name) as string)) {
      const edge = contrast(seen(colors.get("edge") as string, ground), seen(ground, ground));
      assert.ok(edge >= SHAPE, `edge on ${ground} (${theme}): ${edge.toFixed(2)}`);
    }
  }
});

test("values and verdicts can be told apart without green cones", () => {
  for (const [theme, colors] of Object.entries(THEMES)) {
    for (const [a, b] of [
      ["one", "zero"],
      ["good", "bad"],
    ] as const) {
      const [first, second] = [a, b].map(name => seen(colors.get(name) as string, "#ffffff")) as [Rgb, Rgb];
      const found = difference(first, second);
      assert.ok(found >= APART, `${a} and ${b} (${theme}): ${found.toFixed(1)}`);
    }
  }
});

test("threads that follow each other can be told apart without green cones", () => {
  for (const [theme, colors] of Object.entries(THEMES)) {
    const seenThreads = THREADS.map(name => seen(colors.get(name) as string, "#ffffff"));
    seenThreads.forEach((color, i) => {
      const found = difference(color, seenThreads[(i + 1) % THREAD_COLORS] as Rgb);
      assert.ok(found >= APART, `thread ${i + 1} and the next one (${theme}): ${found.toFixed(1)}`);
    });
  }
});

test("materials can be told apart without green cones", () => {
  assert.equal(MATERIALS.length, 8);
  MATERIALS.forEach((a, i) =>
    MATERIALS.slice(i + 1).forEach((b, j) => {
      const found = difference(a, b);
      assert.ok(found >= APART, `materials ${i + 1} and ${i + j + 2}: ${found.toFixed(1)}`);
    }),
  );
});
