// The assistants of a worker with a program, each at a port. They do parts of simulations: of a swarm's cycle, or of
// the bodies of a search. They need no files; what becomes of a part depends on it alone.

import type { FromAssistant, Part } from "./messages";

export class Crew {
  readonly #ready: MessagePort[] = [];

  /** `changed` learns how many can be given parts, `done` what became of a part. */
  constructor(
    private readonly ports: MessagePort[],
    changed: (size: number) => void,
    done: (part: Part) => void,
  ) {
    for (const port of ports) {
      port.onmessage = ({ data }: MessageEvent<FromAssistant>) => {
        if (data !== "ready") {
          done(data);
          return;
        }
        this.#ready.push(port);
        changed(this.#ready.length);
      };
    }
    changed(0);
  }

  give(part: Part): void {
    this.#ready[part.number % this.#ready.length]?.postMessage(part, [part.bytes]);
  }

  close(): void {
    this.ports.forEach(port => port.close());
  }
}
