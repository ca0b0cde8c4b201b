// Workers that do parts of simulations for the worker with a program: of a swarm's cycle, or of the bodies of a search.
// They need no files and no memory of their own; what becomes of a part depends on it alone.

import type { FromWorker, ToWorker } from "./messages";

/** The most of them: a swarm seldom has robots for more. */
const MOST = 7;

export class Crew {
  readonly #workers: Worker[] = [];
  #ready: Worker[] = [];

  /**
   * Starts workers by the script of this one, as far as there are processors. `changed` learns how many can be given
   * parts, `done` what becomes of them.
   */
  constructor(
    module: WebAssembly.Module,
    private readonly changed: (size: number) => void,
    done: (number: number, bytes: ArrayBuffer) => void,
  ) {
    const wanted = Math.min(MOST, (navigator.hardwareConcurrency ?? 1) - 1);
    for (let i = 0; i < wanted; i += 1) {
      const worker = new Worker(location.href);
      worker.onmessage = ({ data }: MessageEvent<FromWorker>) => {
        if (!this.#workers.includes(worker)) {
          return;
        }
        if (data.say === "assisting") {
          this.#ready.push(worker);
          changed(this.#ready.length);
        } else if (data.say === "part") {
          done(data.number, data.bytes);
        } else {
          this.#end();
        }
      };
      worker.onerror = event => {
        event.preventDefault();
        this.#end();
      };
      post(worker, { say: "assist", module });
      this.#workers.push(worker);
    }
  }

  give(number: number, bytes: ArrayBuffer): void {
    const worker = this.#ready[number % this.#ready.length];
    if (worker !== undefined) {
      post(worker, { say: "part", number, bytes }, [bytes]);
    }
  }

  /** Without one of them nothing ends, so the program goes on alone. */
  #end(): void {
    this.#workers.splice(0).forEach(worker => worker.terminate());
    this.#ready = [];
    this.changed(0);
  }
}

function post(worker: Worker, message: ToWorker, transfer: Transferable[] = []): void {
  worker.postMessage(message, { transfer });
}
