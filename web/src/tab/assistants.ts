// Workers that do parts of simulations for a worker with a program. The page starts them: in Firefox a worker that
// starts others itself hangs now and then.

import type { ToWorker } from "./messages";

/** The most of them: a swarm seldom has robots for more. */
const MOST = 7;

export class Assistants {
  readonly #workers: Worker[] = [];

  /** Starts as many as there are processors for. `lead` is given the ports to them, and none once one has failed. */
  constructor(module: WebAssembly.Module, start: () => Worker, lead: (ports: MessagePort[]) => void) {
    const wanted = Math.min(MOST, (navigator.hardwareConcurrency ?? 1) - 1);
    const fail = (event: Event): void => {
      event.preventDefault();
      this.end();
      lead([]);
    };
    const ports = Array.from({ length: wanted }, () => {
      const { port1, port2 } = new MessageChannel();
      const worker = start();
      // All else is said through the port.
      worker.onmessage = worker.onerror = fail;
      worker.postMessage({ say: "assist", module, port: port1 } satisfies ToWorker, [port1]);
      this.#workers.push(worker);
      return port2;
    });
    lead(ports);
  }

  end(): void {
    this.#workers.splice(0).forEach(worker => worker.terminate());
  }
}
