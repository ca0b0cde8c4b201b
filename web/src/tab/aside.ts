// A program beside that of the page, for work that takes long. The page is not kept waiting by it, and can stop it at
// any moment: its worker is ended then.

import type { Contents } from "./files";
import type { ServerMessage } from "../protocol";
import type { Assistants } from "./assistants";
import type { FromWorker, ToWorker } from "./messages";

/** What starts workers: one for a program, and its assistants, to whom `lead` is given the ports. */
export interface Starts {
  program: () => Worker;
  assistants: (lead: (ports: MessagePort[]) => void) => Assistants;
}

export class Aside {
  #worker: Worker | null = null;
  #assistants: Assistants | null = null;
  /** The requests that have no answer yet: what is said to the program for each, by their numbers. */
  readonly #open = new Map<number, string[]>();

  constructor(
    private readonly starts: Starts,
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
      const worker = this.starts.program();
      worker.onmessage = ({ data }: MessageEvent<FromWorker>) => worker === this.#worker && this.#receive(data);
      this.#worker = worker;
    }
    return this.#worker;
  }

  post(message: ToWorker): void {
    this.begin().postMessage(message);
  }

  /** Assistants help to simulate from now on. */
  gather(): void {
    const worker = this.begin();
    this.#assistants ??= this.starts.assistants(ports => {
      if (worker === this.#worker) {
        worker.postMessage({ say: "crew", ports } satisfies ToWorker, ports);
      }
    });
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
    this.#assistants?.end();
    [this.#worker, this.#assistants] = [null, null];
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
