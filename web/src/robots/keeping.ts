// Keeping the designed body as a robot file, and using it in the program.

import { CANCELLED, type Connection } from "../connection";
import { button, element, fill } from "../element";
import type { Program } from "../program";
import { RequestError } from "../request";
import { percent } from "./cards";
import type { Design } from "./designer";

export interface KeepDoors {
  /** Puts a declaration at the start or at the end of the program. */
  declare: (line: string) => void;
  append: (line: string) => void;
  show: () => void;
}

export class Keeping {
  readonly host: HTMLElement;
  readonly #name = element("input", {
    type: "text",
    value: "my_robot",
    spellcheck: "false",
    "aria-label": "Name of the robot",
  });
  readonly #button = button("Keep as a robot", () => void this.#keep(), { "data-do": "keep" });
  readonly #status = element("p", { class: "status", role: "status", "aria-live": "polite" });

  constructor(
    private readonly connection: Connection,
    private readonly design: () => Design,
    private readonly program: Program,
    private readonly doors: KeepDoors,
    private readonly kept: () => void,
  ) {
    this.host = element(
      "div",
      { class: "keeping row" },
      element("label", {}, "name ", this.#name),
      this.#button,
      this.#status,
    );
  }

  /** A swarm that is built of the library, where there is a circuit for it. */
  #offer(use: string): HTMLElement | null {
    const library = /\blibrary\s+(\w+)/.exec(use)?.[1];
    const circuit = this.program.choice.value?.circuit;
    if (library === undefined || circuit === undefined) {
      return null;
    }
    const name = `${circuit.replace(/\W+/g, "_").replace(/_$/, "")}_${library}`;
    const build = async (): Promise<void> => {
      const { program } = this;
      const isDeclared = (): boolean => program.circuits().some(({ swarms }) => swarms.includes(name));
      await program.settled();
      if (!isDeclared()) {
        this.doors.append(`swarm ${name} { circuit: ${circuit}, library: ${library} }`);
        await program.settled();
      }
      if (isDeclared()) {
        program.choose({ circuit, swarm: name });
        this.doors.show();
      }
    };
    return button(`Build ${circuit} from your robots alone`, () => void build(), {
      "data-do": "build",
      title: `Declares a swarm of the library ${library}, and shows it`,
    });
  }

  async #keep(replace = false): Promise<void> {
    const work = new AbortController();
    const shows = this.#showWork(work);
    this.#button.disabled = true;
    const fields = {
      path: this.program.path.value || null,
      name: this.#name.value.trim(),
      body: [...this.design().body],
      replace,
    };
    const { probe } = this.design();
    const errors = probe !== null && "character" in probe ? (probe.character?.error_rate ?? 0) : 0;
    const warning = errors > 0 ? `It errs in ${percent(errors)} of its switches, so a circuit of it may, too. ` : "";
    try {
      const { path, use } = await this.connection.request("keep", fields, { signal: work.signal });
      if (!this.program.text.includes(use)) {
        this.doors.declare(use);
      }
      fill(this.#status, `wrote ${path}; the program has a library with it. ${warning}`, this.#offer(use));
      this.kept();
    } catch (error) {
      this.#fail(error);
    } finally {
      clearInterval(shows);
      this.#button.disabled = false;
    }
  }

  /** Shows for how long the body has been measured, and a button that stops it. The result ends this. */
  #showWork(work: AbortController): number {
    const begun = Date.now();
    const text = element("span", { "aria-live": "off" });
    const tick = (): void => {
      text.textContent = ` measuring it over 1,024 switches: ${Math.round((Date.now() - begun) / 1000)} s `;
    };
    tick();
    fill(
      this.#status,
      element("progress", { "aria-label": "The robot is being measured" }),
      text,
      button("Stop", () => work.abort(), { "data-do": "stop-keep" }),
    );
    return window.setInterval(tick, 1000);
  }

  #fail(error: unknown): void {
    if (!(error instanceof RequestError)) {
      throw error;
    }
    const text = error.code === CANCELLED ? "nothing was kept" : error.words;
    const replace = error.code === "exists" && [
      " ",
      button("Replace it", () => void this.#keep(true), { "data-do": "replace" }),
    ];
    fill(this.#status, text, ...(replace || []));
  }
}
