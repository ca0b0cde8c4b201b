// Files to take away: the program, and what the server makes of the run.

import { wholeOf } from "./live/schematic_parts";
import { CANCELLED, type Connection } from "./connection";
import { download, downloadBytes } from "./download";
import { button, element, fill } from "./element";
import type { LiveSwarm } from "./live/swarm";
import { closeOutside } from "./menu";
import type { Ways } from "./line";
import type { Program } from "./program";
import type { TakeKind, TakenFile } from "./protocol";
import { RequestError } from "./request";
import { takenName, type Taken } from "./taken_names";
import { LinkMenu, type LinkPlaces } from "./share/menu";
import { shareOf } from "./share/share";

const PICTURES: [TakeKind, string][] = [
  ["page", "Report page (HTML)"],
  ["gif", "Film (GIF)"],
  ["png", "Spacetime diagram (PNG)"],
  ["svg", "Spacetime diagram (SVG)"],
  ["vcd", "Waveforms (VCD)"],
  ["csv", "Table of cycles (CSV)"],
];

export class TakeAway {
  readonly host: HTMLElement;
  readonly #status = element("p", { class: "status", role: "status", "aria-live": "polite" });
  readonly #cycles = element("input", {
    type: "number",
    min: 1,
    max: 200,
    value: 40,
    "aria-label": "Cycles up to now",
  });
  #work: AbortController | null = null;

  constructor(
    private readonly connection: Connection,
    private readonly ways: Ways,
    private readonly program: Program,
    private readonly swarm: LiveSwarm,
    tab: () => string,
  ) {
    const links = new LinkMenu(() => shareOf(program, swarm, tab()));
    this.host = element(
      "details",
      { class: "menu take" },
      element("summary", {}, "Share"),
      element(
        "div",
        { class: "sheet" },
        links.host,
        button("Live page (HTML, no server)", () => void this.#export(true), { "data-take": "live" }),
        button("Program (.nb)", () => this.#program(), { "data-take": "nb" }),
        button("Schematic (SVG)", () => this.#schematic(), { "data-take": "schematic" }),
        button("Recorded page of the tests (HTML)", () => void this.#export(false), { "data-take": "recorded" }),
        ...PICTURES.map(([what, label]) => button(label, () => void this.#take(what, label), { "data-take": what })),
        element("label", {}, "of the last ", this.#cycles, " cycles"),
        this.#status,
      ),
    );
    this.host.addEventListener("toggle", () => {
      // What was said of the file before says nothing of the next one.
      if (this.#work === null) {
        fill(this.#status);
      }
      links.show(this.#places());
      this.host.querySelector<HTMLElement>('[data-take="live"]')!.hidden = program.hello?.live_pages !== true;
    });
    closeOutside(this.host as HTMLDetailsElement);
  }

  #places(): LinkPlaces {
    const isOnDisk = location.protocol === "file:";
    const publicPage = this.program.hello?.public_page ?? null;
    return { here: isOnDisk ? null : location.href.replace(/#.*/, ""), isPublic: this.ways.isPublic, publicPage };
  }

  #program(): void {
    downloadBytes(this.program.text, "text/plain", this.program.path.value.split("/").at(-1) ?? "program.nb");
  }

  #schematic(): void {
    const definition = this.swarm.definition.value;
    if (definition !== null) {
      downloadBytes(wholeOf(definition.schematic), "image/svg+xml", this.#name("schematic", "svg"));
    }
  }

  #take(what: TakeKind, label: string): Promise<void> {
    const now = this.swarm.frame.value?.now ?? 0;
    const cycles = Math.max(1, Math.min(now, Number(this.#cycles.value) || 40));
    const named = (ending: string): string =>
      this.#name(what, ending, [Math.max(0, now - cycles) + Number(now > 0), now]);
    return this.#make(label, named, signal => this.connection.request("take", { what, cycles }, { signal }));
  }

  #name(what: Taken["what"], ending: string, cycles?: [number, number]): string {
    const circuit = this.swarm.definition.value?.circuit ?? "circuit";
    const swarm = this.program.choice.value?.swarm ?? null;
    return takenName({ circuit, swarm, what, ending, ...(cycles ? { cycles } : {}) });
  }

  /** The circuit as a page of its own, with the whole simulator, or its tests and simulations as they were recorded. */
  async #export(live: boolean): Promise<void> {
    const choice = this.program.choice.value;
    if (choice !== null) {
      await this.program.settled();
      const path = this.program.path.value;
      const named = (ending: string): string => this.#name(live ? "live" : "recorded", ending);
      await this.#make("the page", named, async signal => {
        await (live ? this.ways.prepare() : null);
        return this.connection.request("export", { path, live, ...choice }, { signal });
      });
    }
  }

  async #make(
    label: string,
    named: (ending: string) => string,
    ask: (signal: AbortSignal) => Promise<TakenFile>,
  ): Promise<void> {
    this.#work?.abort();
    const work = new AbortController();
    this.#work = work;
    fill(
      this.#status,
      `making ${label} … `,
      button("Stop", () => work.abort()),
    );
    try {
      const taken = await ask(work.signal);
      const name = named(taken.name.split(".").at(-1) ?? "");
      download(this.ways.file(taken.url), name);
      fill(this.#status, `${name} is ready`);
    } catch (error) {
      const known = error instanceof RequestError;
      fill(this.#status, known && error.code !== CANCELLED ? error.words : "");
    }
    if (this.#work === work) {
      this.#work = null;
    }
  }
}
