// The robots of the library and of the program, as cards on which they walk.

import { button, element, factList, fill } from "../element";
import { gateName, outputsOf, patterns } from "../gate";
import { truthTableElement } from "../live/inspector";
import type { RobotCard, VoxelLook } from "../protocol";
import { prefersStillness } from "../theme";
import { decodeGait, type Gait } from "./gait";
import { matches } from "./match";
import { drawBody } from "./portrait";
import type { Probing } from "./probing";
import type { Ticker } from "./ticker";
import { GaitView } from "./walk";

/** Cycles that a robot walks under a pattern before the next pattern's turn. */
const CYCLES = 6;

export interface CardDoors {
  design: (body: string[]) => void;
}

export class Cards {
  readonly host: HTMLElement;
  readonly #list = element("div", { class: "cards" });
  readonly #field = element("input", {
    type: "search",
    placeholder: "name or gate, such as nand",
    "aria-label": "Find robots by name or gate",
    spellcheck: "false",
    oninput: () => this.#filter(),
  });
  readonly #count = element("span", { class: "dim", role: "status", "aria-live": "polite" });
  #robots: RobotCard[] = [];
  readonly #observer: IntersectionObserver;
  readonly #begin = new Map<Element, () => () => void>();
  readonly #ends = new Map<Element, () => void>();

  constructor(
    private readonly probing: Probing,
    private readonly ticker: Ticker,
    private readonly doors: CardDoors,
  ) {
    this.#observer = new IntersectionObserver(entries => entries.forEach(entry => this.#see(entry)));
    this.host = element(
      "div",
      { class: "found" },
      element("p", { class: "row" }, this.#field, this.#count),
      this.#list,
    );
  }

  show(robots: RobotCard[], looks: VoxelLook[]): void {
    this.#ends.forEach(end => end());
    this.#ends.clear();
    this.#begin.clear();
    this.#observer.disconnect();
    this.#robots = robots;
    fill(this.#list, ...robots.map(robot => this.#card(robot, looks)));
    this.#filter();
  }

  /** Hides the cards that do not match; a hidden robot does not walk. */
  #filter(): void {
    let count = 0;
    this.#robots.forEach((robot, i) => {
      const found = matches(robot, this.#field.value);
      count += Number(found);
      (this.#list.children[i] as HTMLElement).hidden = !found;
    });
    this.#count.textContent =
      this.#field.value.trim() === "" ? "" : count === 0 ? "no robot matches" : `${count} of ${this.#robots.length}`;
  }

  #see(entry: IntersectionObserverEntry): void {
    this.#ends.get(entry.target)?.();
    this.#ends.delete(entry.target);
    const begin = this.#begin.get(entry.target);
    if (entry.isIntersecting && begin !== undefined) {
      this.#ends.set(entry.target, begin());
    }
  }

  #card(robot: RobotCard, looks: VoxelLook[]): HTMLElement {
    const canvas = element("canvas", { class: "gait", role: "img", "aria-label": `${robot.name} walking` });
    const caption = element("p", { class: "pattern dim" }, "\u00a0");
    const card = element(
      "article",
      { class: "card robot", "data-robot": robot.name },
      element("header", {}, element("h3", {}, gateName(robot.function)), element("span", { class: "dim" }, robot.name)),
      canvas,
      caption,
      element("div", { class: "facts" }, truthTableElement(robot.function), factsOf(robot)),
      robot.painted && button("Open in the designer", () => this.doors.design(robot.body), { "data-do": "design" }),
    );
    this.#begin.set(card, () => this.#walk(robot, canvas, caption, () => drawBody(canvas, robot, looks)));
    this.#observer.observe(card);
    return card;
  }

  /** Lets the robot walk until the result is called; one of other materials than the designer's only stands. */
  #walk(robot: RobotCard, canvas: HTMLCanvasElement, caption: HTMLElement, portrait: () => void): () => void {
    let ended = false;
    let stop = (): void => {};
    portrait();
    if (!robot.painted) {
      return stop;
    }
    this.probing
      .later(robot.body, CYCLES, () => !ended)
      .then(
        probe => {
          if (!ended) {
            const view = new GaitView(canvas, {
              voxels: probe.voxels,
              looks: probe.looks,
              tall: robot.body.length + 1,
              wide: 11,
            });
            stop = this.ticker.add(play(view, probe.gaits.map(decodeGait), probe.letters, caption));
          }
        },
        () => {},
      );
    return () => {
      ended = true;
      stop();
    };
  }
}

function play(view: GaitView, gaits: Gait[], letters: string, caption: HTMLElement): (seconds: number) => void {
  let time = 0;
  let shown = -1;
  return seconds => {
    time = (time + seconds * 4) % (gaits.length * CYCLES);
    const pattern = Math.floor(time / CYCLES);
    const moment = prefersStillness() ? 0 : time % CYCLES;
    if (gaits[pattern] !== undefined) {
      view.draw(gaits[pattern], moment);
    }
    if (pattern !== shown) {
      shown = pattern;
      const way = outputsOf(letters)[pattern] === 1 ? "walks right ▶" : "walks left ◀";
      caption.textContent = `${patterns(gaits.length)[pattern]}: ${way}`;
    }
  };
}

function factsOf(robot: RobotCard): HTMLElement {
  const facts: [string, string][] = [
    ["clock", `${robot.clock} ${robot.clock === 1 ? "cycle" : "cycles"}`],
    ["margin", `${robot.margin.toFixed(3)} voxels`],
    ["errors", percent(robot.error_rate)],
    ["from", robot.shipped ? "the library" : "the program"],
  ];
  return factList(facts);
}

export function percent(share: number): string {
  return share === 0 ? "none" : `${(100 * share).toFixed(2)} %`;
}
