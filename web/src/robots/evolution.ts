// A search for gates that starts from the body in the designer.

import { CANCELLED, type Connection } from "../connection";
import { downloadBytes } from "../download";
import { button, countIn, element } from "../element";
import { Observable } from "../observable";
import type { EliteData } from "../protocol";
import { RequestError } from "../request";
import { Archive, HeatMap } from "./archive";
import { countVoxels, sizeOf, type Body } from "./body";

const GENERATIONS = 60;

export interface Search {
  running: boolean;
  niches: EliteData[];
  chosen: EliteData | null;
}

export class Evolution {
  readonly host: HTMLElement;
  readonly search = new Observable<Search>({ running: false, niches: [], chosen: null });
  readonly #archive = new Archive();
  readonly #map: HeatMap;
  readonly #status = element("p", { class: "status", role: "status" });
  readonly #progress = element("progress", { max: 1, value: 0, hidden: true, "aria-label": "Generations" });
  readonly #generations = element("input", {
    type: "number",
    min: 1,
    max: 2000,
    value: GENERATIONS,
    "aria-label": "Generations",
  });
  readonly #start = button("Evolve from here", () => void this.#toggle(), { class: "primary", "data-do": "evolve" });
  #work: AbortController | null = null;
  #id = -1;

  constructor(
    private readonly connection: Connection,
    private readonly body: () => Body,
    take: (body: Body) => void,
  ) {
    this.#map = new HeatMap(this.#archive, niche => {
      take(niche.body);
      this.search.set({ ...this.search.value, chosen: niche });
    });
    this.host = element(
      "section",
      { class: "evolution card", "aria-label": "Evolution" },
      element("h3", {}, "Evolution"),
      element(
        "p",
        { class: "dim" },
        "Changes the body at random, again and again, and keeps the best of each kind. A square that " +
          "fills is a new kind; click it to see its robot.",
      ),
      element(
        "div",
        { class: "row" },
        this.#start,
        element("label", {}, "for ", this.#generations, " generations"),
        this.#progress,
        button("Save the archive", () => this.#save(), { "data-do": "save-archive", title: "All of it, as JSON" }),
      ),
      this.#status,
      this.#map.host,
    );
    connection.events.on(event => {
      if (event?.event === "archive" && event.id === this.#id) {
        this.#archive.merge(event);
        this.#show(true);
      }
    });
  }

  #save(): void {
    // With the names that earlier files have, too.
    const niches = [...this.#archive.niches.values()].map(one => ({ ...one, place: one.niche, letters: one.behavior }));
    downloadBytes(JSON.stringify({ niches }, null, 2), "application/json", "archive.json");
  }

  async #toggle(): Promise<void> {
    if (this.#work !== null) {
      this.#work.abort();
      return;
    }
    const body = this.body();
    const work = new AbortController();
    this.#work = work;
    this.#archive.clear();
    this.search.set({ running: true, niches: [], chosen: null });
    this.#start.textContent = "Stop";
    this.#progress.hidden = false;
    this.#progress.removeAttribute("value");
    this.#status.textContent = "simulating the first bodies …";
    const generations = countIn(this.#generations, GENERATIONS);
    const fields = {
      body: countVoxels(body) === 0 ? null : [...body],
      box: sizeOf(body),
      generations,
      seed: Math.floor(Math.random() * 2 ** 31),
    };
    let problem = "";
    try {
      await this.connection.request("evolve", fields, {
        signal: work.signal,
        started: id => (this.#id = id),
        progress: (done, all) => {
          this.#progress.max = all;
          this.#progress.value = done;
        },
      });
    } catch (error) {
      problem = error instanceof RequestError && error.code !== CANCELLED ? error.message : "";
    }
    this.#work = null;
    this.#start.textContent = "Evolve from here";
    this.#progress.hidden = true;
    this.#show(false, problem);
  }

  #show(running: boolean, problem = ""): void {
    const { niches, evaluations, generation } = this.#archive;
    const gates = new Set([...niches.values()].map(niche => niche.function)).size;
    this.#status.textContent =
      problem ||
      `generation ${generation}: ${niches.size} kinds, ${gates} different gates, ${evaluations} bodies simulated`;
    this.#map.draw();
    this.search.set({ running, niches: [...niches.values()], chosen: this.search.value.chosen });
  }
}
