// A program beside that of the page, for work that takes long. The page is not kept waiting by it, and can stop it at
// any moment: its worker is ended then.

import type { Contents } from "./files";
import type { ServerMessage } from "../protocol";
import type { FromWorker, ToWorker } from "./messages";

export class Aside {
  #worker: Worker | null = null;
  /** The requests that have no answer yet: what is said to the program for each, by their numbers. */
  readonly #open = new Map<number, string[]>();

  constructor(
    private readonly start: () => Worker,
    private readonly said: (message: FromWorker, from: Aside) => void,
  ) {}

  has(id: number): boolean {
    return this.#open.has(id);
  }

  /** Asks the program; what comes before the request itself has no answer that counts. */
  send(id: number, ...texts: string[]): void {
    this.#open.set(id, texts);
    texts.forEach(text => this.post({ say: "live", text }));
  }

  begin(): Worker {
    if (this.#worker === null) {
      const worker = this.start();
      worker.onmessage = ({ data }: MessageEvent<FromWorker>) => worker === this.#worker && this.#receive(data);
      this.#worker = worker;
    }
    return this.#worker;
  }

  post(message: ToWorker): void {
    this.begin().postMessage(message);
  }

  insert(path: string, text: Contents | null): void {
    this.#worker?.postMessage({ say: "insert", path, text } satisfies ToWorker);
  }

  /** Stops a request, and begins the others again; whether it was one of this program. */
  cancel(id: number): boolean {
    if (!this.has(id)) {
      return false;
    }
    this.#end();
    this.#refuse(id);
    this.#open.forEach((texts, other) => this.send(other, ...texts));
    return true;
  }

  close(): void {
    this.#end();
    [...this.#open.keys()].forEach(id => this.#refuse(id));
  }

  #end(): void {
    this.#worker?.terminate();
    this.#worker = null;
  }

  #refuse(id: number): void {
    this.#open.delete(id);
    const error = { message: "it was cancelled", code: "cancelled", help: null, instead: null, diagnostics: [] };
    this.said({ say: "live", data: JSON.stringify({ id, error } satisfies ServerMessage) }, this);
  }

  #receive(message: FromWorker): void {
    if (message.say === "live" && typeof message.data === "string") {
      const answer = JSON.parse(message.data) as ServerMessage;
      if ("ok" in answer || "error" in answer) {
        this.#open.delete(answer.id);
      }
    }
    this.said(message, this);
  }
}
