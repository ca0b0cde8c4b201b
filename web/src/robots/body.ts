// What can be done to a body: rows from the top, a material's code a character, `0` empty.

import type { PaletteEntry } from "../protocol";

export type Body = readonly string[];

export const LARGEST = 10;
export const EMPTY = "0";
const LEAST_MUSCLES = 3;

export function emptyBody(width: number, height: number): Body {
  return Array.from({ length: height }, () => EMPTY.repeat(width));
}

export function sizeOf(body: Body): [width: number, height: number] {
  return [body[0]?.length ?? 0, body.length];
}

export function voxelAt(body: Body, x: number, y: number): string {
  return body[y]?.[x] ?? EMPTY;
}

export function paint(body: Body, x: number, y: number, code: string): Body {
  const [width, height] = sizeOf(body);
  if (x < 0 || y < 0 || x >= width || y >= height || voxelAt(body, x, y) === code) {
    return body;
  }
  return body.map((row, i) => (i === y ? row.slice(0, x) + code + row.slice(x + 1) : row));
}

/** The body in a box of another size; it keeps its feet and its left side. */
export function resized(body: Body, width: number, height: number): Body {
  const missing = height - body.length;
  const rows = missing >= 0 ? [...emptyBody(width, missing), ...body] : body.slice(-missing);
  return rows.map(row => row.slice(0, width).padEnd(width, EMPTY));
}

export function mirrored(body: Body): Body {
  return body.map(row => [...row].reverse().join(""));
}

/** Exchanges the two stimuli, by exchanging the materials that sense them. */
export function swappedInputs(body: Body, palette: PaletteEntry[]): Body {
  const partners = new Map<string, string>();
  for (const { name, code } of palette) {
    const other = palette.find(candidate => candidate.name === partnerName(name));
    if (other !== undefined) {
      partners.set(code, other.code);
    }
  }
  return body.map(row => [...row].map(code => partners.get(code) ?? code).join(""));
}

/** The name of the material that does with the other stimulus what this one does with its own. */
function partnerName(name: string): string | null {
  const found = /^(.*s)([12])(_.*)$|^(s)([12])(_.*)$/.exec(name);
  if (found === null) {
    return null;
  }
  const [before, digit, after] = found.slice(1).filter(part => part !== undefined) as [string, string, string];
  return `${before}${digit === "1" ? 2 : 1}${after}`;
}

export function countVoxels(body: Body): number {
  return body.join("").replaceAll(EMPTY, "").length;
}

export function isConnected(body: Body): boolean {
  const start = placesOf(body).find(([x, y]) => voxelAt(body, x, y) !== EMPTY);
  if (start === undefined) {
    return false;
  }
  const reached = new Set([start.join()]);
  for (const waiting = [start]; waiting.length > 0; ) {
    const [x, y] = waiting.pop() as [number, number];
    for (const next of neighbors(x, y)) {
      if (voxelAt(body, ...next) !== EMPTY && !reached.has(next.join())) {
        reached.add(next.join());
        waiting.push(next);
      }
    }
  }
  return reached.size === countVoxels(body);
}

function neighbors(x: number, y: number): [number, number][] {
  return [
    [x - 1, y],
    [x + 1, y],
    [x, y - 1],
    [x, y + 1],
  ];
}

/** The materials of a random body after this one: those that sense a third stimulus only if it has one of them. */
export function drawnFrom(body: Body, palette: PaletteEntry[]): PaletteEntry[] {
  const isThird = ({ name }: PaletteEntry): boolean => /^s3_/.test(name);
  const third = palette.filter(isThird).map(({ code }) => code);
  return third.some(code => body.join("").includes(code)) ? palette : palette.filter(entry => !isThird(entry));
}

/** A connected body of random materials that stands on the ground and can move. */
export function randomBody(
  width: number,
  height: number,
  palette: PaletteEntry[],
  random: () => number = Math.random,
): Body {
  const codes = palette.map(entry => entry.code).filter(code => code !== EMPTY);
  const pick = <T>(list: readonly T[]): T => list[Math.floor(random() * list.length)] as T;
  const actuators = palette.filter(entry => /muscle|actuator/.test(entry.name + entry.about)).map(entry => entry.code);
  const wanted = Math.max(LEAST_MUSCLES, Math.ceil(width * height * (0.45 + 0.4 * random())));
  let body = paint(
    emptyBody(width, height),
    Math.floor(width / 2),
    height - 1,
    pick(actuators.length > 0 ? actuators : codes),
  );
  while (countVoxels(body) < Math.min(wanted, width * height)) {
    body = paint(body, ...pick(border(body)), pick(codes));
  }
  return withMuscles(body, actuators, pick);
}

/** The body with enough of these materials, in place of others if need be. */
function withMuscles(body: Body, muscles: string[], pick: <T>(list: readonly T[]) => T): Body {
  const others = (): [number, number][] =>
    placesOf(body).filter(([x, y]) => voxelAt(body, x, y) !== EMPTY && !muscles.includes(voxelAt(body, x, y)));
  while (muscles.length > 0 && countVoxels(body) - others().length < LEAST_MUSCLES && others().length > 0) {
    body = paint(body, ...pick(others()), pick(muscles));
  }
  return body;
}

function placesOf(body: Body): [number, number][] {
  const [width, height] = sizeOf(body);
  return Array.from({ length: width * height }, (_, i) => [i % width, Math.floor(i / width)]);
}

function border(body: Body): [number, number][] {
  const free = (x: number, y: number): boolean => voxelAt(body, x, y) === EMPTY;
  return placesOf(body).filter(([x, y]) => free(x, y) && neighbors(x, y).some(([a, b]) => !free(a, b)));
}
