// How the body in the designer walks under each pattern, and what follows from it.

import { element, factList, fill } from "../element";
import { gateName, patterns } from "../gate";
import { truthTableElement } from "../live/inspector";
import type { ProbeReport } from "../protocol";
import { prefersStillness } from "../theme";
import { sizeOf } from "./body";
import { percent } from "./cards";
import type { Design } from "./designer";
import { decodeGait } from "./gait";
import type { Ticker } from "./ticker";
import { GaitView } from "./walk";

export class ProbeView {
  readonly host = element("section", { class: "probe", "aria-label": "How it walks" });
  readonly #title = element("h3", { role: "status", "aria-live": "polite" });
  readonly #lanes = element("div", { class: "lanes" });
  readonly #facts = element("div", { class: "facts" });
  #stop: () => void = () => {};

  constructor(private readonly ticker: Ticker) {
    this.host.append(this.#title, this.#lanes, this.#facts);
  }

  /** Lanes go on walking when only the numbers are new. */
  #shown = "";

  show({ body, probe }: Design): void {
    this.host.toggleAttribute("data-waiting", probe === null);
    if (probe === null) {
      // What was wrong with the body before says nothing about this one.
      if (this.host.dataset["letters"] === "") {
        this.#title.textContent = "simulating it …";
      }
      return;
    }
    if ("fault" in probe) {
      this.#stop();
      this.#shown = "";
      this.host.dataset["letters"] = "";
      this.#title.textContent = probe.fault;
      fill(this.#lanes);
      fill(this.#facts);
      return;
    }
    this.host.dataset["letters"] = probe.letters;
    this.#title.textContent = gateName(probe.function);
    if (this.#shown !== body.join()) {
      this.#shown = body.join();
      this.#stop();
      this.#showLanes(probe, sizeOf(body)[1]);
    }
    fill(this.#facts, truthTableElement(probe.function, [...probe.letters].map(letterValue)), this.#numbers(probe));
  }

  #showLanes(probe: ProbeReport, height: number): void {
    const gaits = probe.gaits.map(decodeGait);
    const views = patterns(gaits.length).map((pattern, i) => {
      const letter = probe.letters[i] ?? "?";
      const canvas = element("canvas", {
        class: "gait",
        role: "img",
        "aria-label": `under ${pattern}: ${directionOf(letter)}`,
      });
      const lane = element(
        "div",
        { class: "lane" },
        element("span", { class: "pattern" }, pattern),
        canvas,
        element("span", { class: "letter", "data-letter": letter, title: directionOf(letter) }, letter),
      );
      return {
        lane,
        view: new GaitView(canvas, { voxels: probe.voxels, looks: probe.looks, tall: height + 1, wide: 11 }),
      };
    });
    this.#lanes.toggleAttribute("data-many", gaits.length > 4);
    fill(this.#lanes, ...views.map(({ lane }) => lane));
    let time = 0;
    this.#stop = this.ticker.add(seconds => {
      const cycles = gaits[0]?.cycles ?? 1;
      time = prefersStillness() ? cycles : (time + 4 * seconds) % cycles;
      views.forEach(({ view }, i) => gaits[i] !== undefined && view.draw(gaits[i], time));
    });
  }

  #numbers({ character, displacement, letters }: ProbeReport): HTMLElement {
    const all = patterns(letters.length);
    const facts: [string, string][] = [
      ["behavior", `${letters} (under ${all.length > 4 ? `${all[0]} to ${all.at(-1)}` : all.join(", ")})`],
      ["walks", displacement.map(voxels => voxels.toFixed(2)).join(", ") + " voxels"],
    ];
    if (character === null) {
      facts.push(["as a gate", "being measured …"]);
    } else {
      facts.push(
        ["clock", `${character.clock} ${character.clock === 1 ? "cycle" : "cycles"}`],
        ["margin", `${character.margin.toFixed(3)} voxels a cycle`],
        ["errors", `${percent(character.error_rate)} in ${character.switches} switches`],
        ...(character.topples ? [["falls over", "sometimes"] satisfies [string, string]] : []),
      );
    }
    return factList(facts);
  }
}

function letterValue(letter: string): number {
  return letter === "R" ? 1 : 0;
}

function directionOf(letter: string): string {
  return letter === "R" ? "walks right: 1" : letter === "L" ? "walks left: 0" : "walks nowhere in particular";
}
