// The line for everything but the language server: requests with their answers, events and frames.

import type { Dial, Line } from "./line";
import { Observable } from "./observable";
import type { PlayEvent, ServerMessage, TestVerdict } from "./protocol";
import { RequestError, type Fields, type Result, type Verb } from "./request";

export type ConnectionState = "connecting" | "open" | "lost";

export interface RequestOptions {
  progress?: (done: number, all: number) => void;
  found?: (results: TestVerdict[]) => void;
  signal?: AbortSignal;
  /** Called with the number of the request, to which events may refer. */
  started?: (id: number) => void;
}

interface Pending extends RequestOptions {
  resolve: (result: never) => void;
  reject: (error: Error) => void;
}

/** The code of the error that requests end with when the server is lost. */
export const LOST = "lost";
export const CANCELLED = "cancelled";

const FIRST_WAIT = 250;
const LONGEST_WAIT = 4000;

export class Connection {
  readonly state = new Observable<ConnectionState>("connecting");
  readonly events = new Observable<PlayEvent | null>(null);
  onframe: (buffer: ArrayBuffer) => void = () => {};
  #line: Line | null = null;
  #pending = new Map<number, Pending>();
  #next = 1;
  #wait = FIRST_WAIT;
  #timer = 0;

  constructor(private readonly dial: Dial) {}

  open(): void {
    clearTimeout(this.#timer);
    this.#line = this.dial({
      opened: () => {
        this.#wait = FIRST_WAIT;
        this.state.set("open");
      },
      received: data => this.#receive(data),
      closed: () => this.#lose(),
    });
  }

  request<V extends Verb>(verb: V, fields: Fields<V>, options: RequestOptions = {}): Promise<Result<V>> {
    const id = this.#next++;
    return new Promise((resolve, reject) => {
      if (this.state.value !== "open") {
        reject(new RequestError({ message: "the connection to the program is lost", code: LOST }));
        return;
      }
      this.#pending.set(id, { ...options, resolve: resolve as (result: never) => void, reject });
      options.signal?.addEventListener("abort", () => this.#cancel(id));
      this.#send({ id, do: verb, ...fields });
      options.started?.(id);
    });
  }

  /** Sends what has no answer worth waiting for; after a loss the state is restored anyway. */
  tell<V extends Verb>(verb: V, fields: Fields<V>): void {
    this.request(verb, fields).catch(() => {});
  }

  #send(message: object): void {
    this.#line?.send(JSON.stringify(message));
  }

  /** The program ends the work in its own time; who waits for it is not kept waiting. */
  #cancel(id: number): void {
    const pending = this.#pending.get(id);
    if (pending !== undefined) {
      this.#pending.delete(id);
      this.#send({ id: this.#next++, do: "cancel", of: id });
      pending.reject(new RequestError({ message: "it was cancelled", code: CANCELLED }));
    }
  }

  #receive(data: string | ArrayBuffer): void {
    if (typeof data !== "string") {
      this.onframe(data);
      return;
    }
    const message = JSON.parse(data) as ServerMessage;
    if ("event" in message) {
      this.events.set(message);
    } else if ("progress" in message) {
      this.#pending.get(message.id)?.progress?.(...message.progress);
    } else if ("found" in message) {
      this.#pending.get(message.id)?.found?.(message.found);
    } else {
      const pending = this.#pending.get(message.id);
      this.#pending.delete(message.id);
      if ("error" in message) {
        pending?.reject(new RequestError(message.error));
      } else {
        pending?.resolve(message.ok as never);
      }
    }
  }

  #lose(): void {
    const pending = [...this.#pending.values()];
    this.#pending.clear();
    for (const { reject } of pending) {
      reject(new RequestError({ message: "the connection to the program is lost", code: LOST }));
    }
    this.state.set("lost");
    this.#timer = window.setTimeout(() => this.open(), this.#wait);
    this.#wait = Math.min(LONGEST_WAIT, this.#wait * 2);
  }
}
