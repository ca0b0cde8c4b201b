// The program in a worker of the page. One that has failed is replaced: the page then says again what it works on.

import type { Dial, LineEvents, Ways } from "../line";
import { Observable } from "../observable";
import type { FromWorker, Source, Start, ToWorker } from "./messages";

export interface TabOptions extends Start {
  /** Starts the worker. */
  worker: () => Worker;
  program: () => Source;
  /** The address of the page that live exports are made of, if they can be made. */
  template?: string;
}

/** The most files that are kept for the page to fetch, which it does at once. */
const MOST_FILES = 8;

const KEEPS_NOTHING = "This browser keeps no files: save what you need with Take away.";

export class TabHost implements Ways {
  readonly live: Dial = events => this.#dial("live", events);
  readonly language: Dial = events => this.#dial("language", events);
  readonly status = new Observable("Loading the simulator …");
  readonly #files = new Map<string, string>();
  readonly #lines: { live: LineEvents | null; language: LineEvents | null } = { live: null, language: null };
  #worker: Worker | null = null;
  #prepared: () => void = () => {};
  #isReady = false;

  constructor(private readonly options: TabOptions) {}

  /** The address of a file that the program has made. */
  readonly file = (address: string): string => this.#files.get(address) ?? address;

  /** Loads what live exports are made of. */
  prepare(): Promise<void> {
    const { template } = this.options;
    const worker = this.#worker;
    if (template === undefined || worker === null) {
      return Promise.resolve();
    }
    return new Promise(resolve => {
      this.#prepared = resolve;
      post(worker, { say: "template", address: template });
    });
  }

  #dial(name: "live" | "language", events: LineEvents): { send: (text: string) => void; close: () => void } {
    this.#worker ??= this.#start();
    const worker = this.#worker;
    this.#lines[name] = events;
    if (name === "language") {
      post(worker, { say: "greet" });
    }
    if (this.#isReady) {
      queueMicrotask(events.opened);
    }
    return {
      send: text => post(worker, { say: name, text }),
      close: () => {
        if (this.#lines[name] === events) {
          this.#lines[name] = null;
        }
      },
    };
  }

  #start(): Worker {
    const worker = this.options.worker();
    worker.onmessage = ({ data }: MessageEvent<FromWorker>) => this.#receive(worker, data);
    worker.onerror = event => {
      event.preventDefault();
      this.#fail(worker, event.message ?? "the worker cannot be started");
    };
    const { first, files, keeps, program } = this.options;
    post(worker, { say: "begin", program: program(), first, files, keeps });
    return worker;
  }

  #receive(worker: Worker, message: FromWorker): void {
    switch (message.say) {
      case "loading":
        this.status.set(`Loading the simulator: ${share(message.done, message.all)} of ${megabytes(message.all)}`);
        break;
      case "ready":
        this.#isReady = true;
        this.status.set(message.keeps || !this.options.keeps ? "" : KEEPS_NOTHING);
        this.#lines.live?.opened();
        this.#lines.language?.opened();
        break;
      case "live":
        this.#lines.live?.received(message.data);
        if (typeof message.data !== "string") {
          post(worker, { say: "drawn" });
        }
        break;
      case "language":
        this.#lines.language?.received(message.text);
        break;
      case "template":
        this.#prepared();
        break;
      case "file": {
        const { address, type, bytes } = message;
        this.#files.set(address, URL.createObjectURL(new Blob([bytes], { type })));
        const [oldest] = this.#files;
        if (oldest !== undefined && this.#files.size > MOST_FILES) {
          this.#files.delete(oldest[0]);
          URL.revokeObjectURL(oldest[1]);
        }
        break;
      }
      case "unkept":
        this.status.set(`This browser could not keep ${message.path}: save it with Take away.`);
        break;
      case "failed":
        this.#fail(worker, message.message);
        break;
    }
  }

  #fail(worker: Worker, message: string): void {
    worker.terminate();
    if (worker !== this.#worker) {
      return;
    }
    this.#worker = null;
    this.#isReady = false;
    this.#prepared();
    this.status.set(`The program failed and is started again: ${message}`);
    const { live, language } = this.#lines;
    [this.#lines.live, this.#lines.language] = [null, null];
    live?.closed();
    language?.closed();
  }
}

function post(worker: Worker, message: ToWorker): void {
  worker.postMessage(message);
}

function share(done: number, all: number): string {
  return `${Math.min(100, Math.round((100 * done) / all))} %`;
}

function megabytes(bytes: number): string {
  return `${(bytes / 1e6).toFixed(1)} MB`;
}
