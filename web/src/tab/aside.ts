// A program beside that of the page, for work that takes long, such as measuring a robot. The page is not kept waiting
// by it, and can stop it at any moment: its worker is ended then.

import type { ServerMessage } from "../protocol";
import type { FromWorker, Start, ToWorker } from "./messages";

export interface AsideEvents {
  /** A message for the page. */
  received: (text: string) => void;
  /** A file was written. */
  wrote: (path: string, text: string | null) => void;
  failed: (message: string) => void;
}

export class Aside {
  #worker: Worker | null = null;
  /** The requests that have no answer yet, by their numbers. */
  readonly #open = new Map<number, string>();

  constructor(
    private readonly start: () => { worker: Worker; begin: Start },
    private readonly events: AsideEvents,
  ) {}

  send(id: number, text: string): void {
    this.#open.set(id, text);
    this.#begun().postMessage({ say: "live", text } satisfies ToWorker);
  }

  /** Stops a request, and begins the others again; whether it was one of this program. */
  cancel(id: number): boolean {
    if (!this.#open.delete(id)) {
      return false;
    }
    this.#end();
    const error = { message: "it was cancelled", code: "cancelled", help: null, instead: null, diagnostics: [] };
    this.events.received(JSON.stringify({ id, error } satisfies ServerMessage));
    this.#open.forEach((text, other) => this.send(other, text));
    return true;
  }

  /** Adds a file, or replaces it; without a text, deletes it. */
  insert(path: string, text: string | null): void {
    this.#worker?.postMessage({ say: "insert", path, text } satisfies ToWorker);
  }

  close(): void {
    this.#open.clear();
    this.#end();
  }

  #end(): void {
    this.#worker?.terminate();
    this.#worker = null;
  }

  #begun(): Worker {
    if (this.#worker === null) {
      const { worker, begin } = this.start();
      worker.onmessage = ({ data }: MessageEvent<FromWorker>) => worker === this.#worker && this.#receive(data);
      worker.postMessage({ say: "begin", ...begin } satisfies ToWorker);
      this.#worker = worker;
    }
    return this.#worker;
  }

  #receive(message: FromWorker): void {
    if (message.say === "live" && typeof message.data === "string") {
      const said = JSON.parse(message.data) as ServerMessage;
      if ("ok" in said || "error" in said) {
        this.#open.delete(said.id);
      }
      this.events.received(message.data);
    } else if (message.say === "wrote") {
      this.events.wrote(message.path, message.text);
    } else if (message.say === "failed") {
      this.events.failed(message.message);
    }
  }
}
