// Asks the server how bodies walk; a few at a time, each body once.

import type { Connection } from "../connection";
import type { ProbeResult } from "../protocol";

const AT_ONCE = 2;
const KEPT = 200;

export class Probing {
  readonly #known = new Map<string, Promise<ProbeResult>>();
  readonly #waiting: (() => void)[] = [];
  #working = 0;

  constructor(private readonly connection: Connection) {}

  of(body: readonly string[], cycles: number): Promise<ProbeResult> {
    const key = `${cycles}:${body.join("/")}`;
    const known = this.#known.get(key);
    if (known !== undefined) {
      return known;
    }
    const asked = this.#ask(body, cycles);
    this.#known.set(key, asked);
    asked.catch(() => this.#known.delete(key));
    if (this.#known.size > KEPT) {
      this.#known.delete(this.#known.keys().next().value as string);
    }
    return asked;
  }

  async #ask(body: readonly string[], cycles: number): Promise<ProbeResult> {
    if (this.#working >= AT_ONCE) {
      await new Promise<void>(resolve => this.#waiting.push(resolve));
    }
    this.#working++;
    try {
      return await this.connection.request("probe", { body: [...body], cycles });
    } finally {
      this.#working--;
      this.#waiting.shift()?.();
    }
  }
}
