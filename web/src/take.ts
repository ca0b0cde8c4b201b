// Files to take away: the program, and what the server makes of the run.

import { wholeOf } from "./live/schematic_parts";
import { CANCELLED, type Connection } from "./connection";
import { button, element, fill } from "./element";
import type { LiveSwarm } from "./live/swarm";
import { closeOutside } from "./menu";
import type { Ways } from "./line";
import type { Program } from "./program";
import type { TakeKind, TakenFile } from "./protocol";
import { RequestError } from "./request";
import { LinkMenu } from "./share/menu";
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
      element("summary", {}, "Take away"),
      element(
        "div",
        { class: "sheet" },
        links.host,
        button("Program (.nb)", () => this.#program(), { "data-take": "nb" }),
        button("Schematic (SVG)", () => this.#schematic(), { "data-take": "schematic" }),
        button("Live page (HTML, no server)", () => void this.#export(true), { "data-take": "live" }),
        button("Recorded page (HTML, smaller)", () => void this.#export(false), { "data-take": "player" }),
        ...PICTURES.map(([what, label]) => button(label, () => void this.#take(what, label), { "data-take": what })),
        element("label", {}, "of the last ", this.#cycles, " cycles"),
        this.#status,
      ),
    );
    this.host.addEventListener("toggle", () => {
      this.host.querySelector<HTMLElement>('[data-take="live"]')!.hidden = program.hello?.live_pages !== true;
    });
    closeOutside(this.host as HTMLDetailsElement);
  }

  #program(): void {
    downloadText(this.program.text, "text/plain", this.program.path.value.split("/").at(-1) ?? "program.nb");
  }

  #schematic(): void {
    const definition = this.swarm.definition.value;
    if (definition !== null) {
      downloadText(wholeOf(definition.schematic), "image/svg+xml", `${definition.circuit.replace(/\W+/g, "_")}.svg`);
    }
  }

  #take(what: TakeKind, label: string): Promise<void> {
    const now = this.swarm.frame.value?.now ?? 0;
    const cycles = Math.max(1, Math.min(now, Number(this.#cycles.value) || 40));
    return this.#make(label, signal => this.connection.request("take", { what, cycles }, { signal }));
  }

  /** The circuit as a page of its own, with the whole simulator or as a recording. */
  async #export(live: boolean): Promise<void> {
    const choice = this.program.choice.value;
    if (choice !== null) {
      await this.program.settled();
      const path = this.program.path.value;
      await this.#make("the page", async signal => {
        await (live ? this.ways.prepare() : null);
        return this.connection.request("export", { path, live, ...choice }, { signal });
      });
    }
  }

  async #make(label: string, ask: (signal: AbortSignal) => Promise<TakenFile>): Promise<void> {
    this.#work?.abort();
    const work = new AbortController();
    this.#work = work;
    fill(
      this.#status,
      `making ${label} … `,
      button("Stop", () => work.abort()),
    );
    try {
      const { url, name } = await ask(work.signal);
      download(this.ways.file(url), name);
      fill(this.#status, `${name} is ready`);
    } catch (error) {
      const known = error instanceof RequestError;
      fill(
        this.#status,
        known && error.code !== CANCELLED ? `${error.message}${error.help ? `; ${error.help}` : ""}` : "",
      );
    }
  }
}

function downloadText(text: string, type: string, name: string): void {
  const url = URL.createObjectURL(new Blob([text], { type }));
  download(url, name);
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

function download(url: string, name: string): void {
  const link = element("a", { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
}
