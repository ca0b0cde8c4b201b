// An exported page: the views of a swarm over an engine of its own, the rows of the tests, and what the page is.

import { element, iconButton } from "../element";
import { LiveSwarm } from "../live/swarm";
import { SwarmViews, summaryOf } from "../live/views";
import { prefersStillness, switchTheme, theme } from "../theme";
import { Engine } from "./engine";
import type { Machine } from "./machine";
import { TestTable } from "./tests";

export class PlayerPage {
  readonly #swarm: LiveSwarm;
  readonly #views: SwarmViews;

  constructor(private readonly machine: Machine) {
    this.#swarm = new LiveSwarm(new Engine(machine));
    this.#views = new SwarmViews(this.#swarm, this.#head(), true);
  }

  start(): void {
    const { tests } = this.machine.recording;
    document.body.append(
      element(
        "div",
        { class: "player" },
        this.#top(),
        element("main", { class: "live" }, this.#views.host),
        tests.length > 0 && new TestTable(this.machine).host,
        this.#about(),
      ),
    );
    this.#swarm.begin(this.machine.swarm);
    document.addEventListener("visibilitychange", () => this.#swarm.watch(!document.hidden));
    addEventListener("keydown", event => this.#press(event));
    if (!prefersStillness()) {
      this.#swarm.play();
    }
  }

  #top(): HTMLElement {
    const light = iconButton(
      "theme",
      "Light or dark",
      () => {
        switchTheme();
        light.setAttribute("aria-pressed", String(theme() === "dark"));
      },
      { "data-do": "theme" },
    );
    return element(
      "header",
      { class: "head" },
      element("h1", {}, element("span", { class: "mark", "aria-hidden": "true" }), this.machine.swarm.circuit),
      element("span", { class: "folder" }, this.machine.recording.file),
      element("span", { class: "space" }),
      light,
    );
  }

  #head(): HTMLElement {
    return element(
      "div",
      { class: "head" },
      element("p", { class: "status" }, summaryOf(this.machine.swarm)),
      element(
        "p",
        { class: "plain dim", title: "The walks are from the physics of nbc; the bits are computed by this page" },
        "Recorded walks, computed bits",
      ),
    );
  }

  #about(): HTMLElement {
    const { version, file } = this.machine.recording;
    return element(
      "footer",
      { class: "about dim" },
      element(
        "p",
        {},
        `Made by nbc ${version} from ${file}. This page is a recording with logic, not a simulation: how each robot ` +
          "walks under each pattern of its stimuli was recorded in the physics of nbc, on flat ground, and the page " +
          "computes the bits with the time that each robot needs to answer. It needs no network.",
      ),
    );
  }

  /** Space plays and pauses, and a period is one cycle, wherever nothing else takes these keys. */
  #press(event: KeyboardEvent): void {
    const target = event.target as HTMLElement;
    const busy = target.closest?.("input, select, button, summary, [role=button]") !== null;
    if (busy || event.ctrlKey || event.metaKey || event.altKey) {
      return;
    }
    if (event.key === " ") {
      event.preventDefault();
      this.#views.controls.toggle();
    } else if (event.key === ".") {
      this.#swarm.step();
    }
  }
}
