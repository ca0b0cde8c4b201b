// The tab with robots: the designer, and the cards of all that there are.

import { counted } from "../counted";
import type { Connection } from "../connection";
import { element } from "../element";
import type { Program } from "../program";
import { Cards } from "./cards";
import { Designer } from "./designer";
import { Evolution } from "./evolution";
import { Keeping, type KeepDoors } from "./keeping";
import { Probing } from "./probing";
import { ProbeView } from "./result";
import { Ticker } from "./ticker";

export class RobotsPanel {
  readonly host: HTMLElement;
  readonly designer: Designer;
  readonly evolution: Evolution;
  readonly #ticker = new Ticker();
  readonly #cards: Cards;
  readonly #status = element("p", { class: "status" });
  #loaded: string | null = null;
  #visible = false;
  #shown = "";

  constructor(
    private readonly connection: Connection,
    private readonly program: Program,
    doors: KeepDoors,
  ) {
    const probing = new Probing(connection);
    this.designer = new Designer(probing);
    this.evolution = new Evolution(
      connection,
      () => this.designer.body,
      body => this.designer.take(body),
    );
    const result = new ProbeView(this.#ticker);
    const keeping = new Keeping(
      connection,
      () => this.designer.design.value,
      program,
      doors,
      () => void this.#load(),
    );
    this.#cards = new Cards(probing, this.#ticker, {
      design: body => {
        this.designer.take(body);
        this.designer.host.scrollIntoView({ block: "start" });
      },
    });
    this.designer.design.follow(design => result.show(design));
    this.host = element(
      "div",
      { class: "robots" },
      element("h2", {}, "Designer"),
      element("div", { class: "design card" }, this.designer.host, result.host, keeping.host),
      this.evolution.host,
      element("h2", {}, "Robots"),
      this.#status,
      this.#cards.host,
    );
    connection.state.on(state => {
      this.#loaded = null;
      if (state === "open" && this.#visible) {
        void this.#load();
      }
    });
  }

  /** Notes whether the tab is shown; what is not seen does not work. */
  shown(visible: boolean): void {
    this.#visible = visible;
    this.#ticker.turn(visible);
    if (visible && this.#loaded !== this.#key()) {
      void this.#load();
    }
  }

  #key(): string {
    return `${this.program.path.value}\n${this.program.text}`;
  }

  async #load(): Promise<void> {
    const key = this.#key();
    try {
      const robots = await this.connection.request("robots", { path: this.program.path.value || null });
      this.#loaded = key;
      this.#status.textContent = counted(robots.robots.length, "robot");
      // Cards of the same robots stay as they are, and go on walking.
      const shown = JSON.stringify(robots);
      if (shown !== this.#shown) {
        this.#shown = shown;
        this.designer.setMaterials(robots);
        this.#cards.show(robots.robots, robots.looks);
      }
    } catch (error) {
      this.#status.textContent = (error as Error).message;
    }
  }
}
