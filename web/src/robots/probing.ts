// Asks the server how bodies walk. Each body is asked for once, and those that nobody sees any more are not.

import type { Connection } from "../connection";
import type { ProbeReport } from "../protocol";

const AT_ONCE = 2;
const KEPT = 200;

interface Waiting {
  body: readonly string[];
  cycles: number;
  wanted: () => boolean;
  begin: () => void;
}

export class Probing {
  readonly #known = new Map<string, Promise<ProbeReport>>();
  #waiting: Waiting[] = [];
  #working = 0;

  constructor(private readonly connection: Connection) {}

  /** The gaits of a body of the gallery, as soon as it is its turn; never if it is no longer wanted then. */
  later(body: readonly string[], cycles: number, wanted: () => boolean): Promise<ProbeReport> {
    return new Promise((resolve, reject) => {
      const begin = (): void => {
        this.#working++;
        const done = (): void => {
          this.#working--;
          this.#next();
        };
        this.now(body, cycles).then(resolve, reject).finally(done);
      };
      this.#waiting.push({ body, cycles, wanted, begin });
      this.#next();
    });
  }

  /** The gaits of a body, before all that wait. */
  now(body: readonly string[], cycles: number, signal?: AbortSignal): Promise<ProbeReport> {
    const key = `${cycles}:${body.join("/")}`;
    const known = this.#known.get(key);
    if (known !== undefined) {
      return known;
    }
    const asked = this.connection.request(
      "probe",
      { body: [...body], cycles, character: false },
      signal ? { signal } : {},
    );
    this.#known.set(key, asked);
    asked.catch(() => this.#known.delete(key));
    if (this.#known.size > KEPT) {
      this.#known.delete(this.#known.keys().next().value as string);
    }
    return asked;
  }

  /** The gaits with the character of the gate, which takes many more simulations. */
  thoroughly(body: readonly string[], cycles: number, signal: AbortSignal): Promise<ProbeReport> {
    return this.connection.request("probe", { body: [...body], cycles, character: true }, { signal });
  }

  #next(): void {
    this.#waiting = this.#waiting.filter(({ wanted }) => wanted());
    while (this.#working < AT_ONCE) {
      const first = this.#waiting.shift();
      if (first === undefined) {
        return;
      }
      first.begin();
    }
  }
}
