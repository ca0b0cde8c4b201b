// What is known of the tests or claims of the present text, by their numbers.

import { CANCELLED } from "../connection";
import { button, element } from "../element";
import { Observable } from "../observable";
import { RequestError } from "../request";

export type Attempt<Done> =
  | ({ state: "running"; done: number; all: number; work: AbortController } & Partial<Done>)
  | ({ state: "done" } & Done)
  | ({ state: "failed"; message: string } & Partial<Done>);

export interface Sending<Done> {
  signal: AbortSignal;
  progress: (done: number, all: number) => void;
  /** Takes what is known before the end; it stays when the work is stopped. */
  know: (known: Done) => void;
}

interface Declared {
  index: number;
  circuit: string;
  title: string;
}

export class Attempts<Done> {
  readonly states = new Observable(new Map<number, Attempt<Done>>());

  /** Stops all, because the text has changed. */
  clear(): void {
    for (const state of this.states.value.values()) {
      if (state.state === "running") {
        state.work.abort();
      }
    }
    this.states.set(new Map());
  }

  async run(index: number, ask: (sending: Sending<Done>) => Promise<Done>): Promise<void> {
    const work = new AbortController();
    const states = this.states.value;
    const set = (state: Attempt<Done>): void => {
      // After an edit the result is about what is no longer there.
      if (states === this.states.value) {
        states.set(index, state);
        this.states.notify();
      }
    };
    let known: Partial<Done> = {};
    const know = (now: Done): unknown => (known = now);
    const progress = (done: number, all: number): void => set({ state: "running", done, all, work, ...known });
    progress(0, 0);
    try {
      set({ state: "done", ...(await ask({ signal: work.signal, progress, know })) });
    } catch (error) {
      if (error instanceof RequestError) {
        set({ state: "failed", message: error.code === CANCELLED ? "stopped" : error.words, ...known });
      }
    }
  }
}

/** Where a declaration is in the present text. */
export function placeOf({ circuit, title, index }: Declared, all: Declared[]): number | undefined {
  const same = all.filter(one => one.circuit === circuit && one.title === title);
  return (same.find(one => one.index === index) ?? same[0] ?? all[index])?.index;
}

/** What is shown while it runs, or if it failed. */
export function attemptBar(attempt: Attempt<unknown> | undefined): HTMLElement | null {
  if (attempt?.state === "failed") {
    return element("span", { class: "verdict fail" }, attempt.message);
  }
  if (attempt?.state !== "running") {
    return null;
  }
  const { done, all, work } = attempt;
  return element(
    "span",
    { class: "verdict" },
    element("progress", { max: Math.max(1, all), value: all === 0 ? null : done, "aria-label": "Progress" }),
    button("Stop", () => work.abort(), { "data-do": "stop" }),
  );
}
