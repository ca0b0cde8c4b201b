// The program in a worker of the page. One that has failed is replaced: the page then says again what it works on.

import type { BrowserFolder, Dial, LineEvents, Ways } from "../line";
import { Observable } from "../observable";
import type { Request } from "../protocol";
import { Aside } from "./aside";
import type { FromWorker, Source, Start, ToWorker } from "./messages";

export interface TabOptions extends Omit<Start, "program" | "alone"> {
  /** Starts a worker. */
  worker: () => Worker;
  program: () => Source;
  /** The address of the page that live exports are made of, if they can be made. */
  template?: string;
}

/** Milliseconds in which the program is alone, so that the page is there soon. */
const ALONE = 1000;
/** The most files that are kept for the page to fetch, which it does at once. */
const MOST_MADE = 8;
/** Requests that take long, each with the program that does them, and what stops one. */
const ASIDE = /"do":"(probe|evolve|keep|cancel)"/;
const PLACES: { [Verb in Request["do"]]?: "probe" | "search" } = { probe: "probe", evolve: "search", keep: "search" };

const KEEPS_NOTHING = "This browser keeps no files: save what you need with Take away.";

export class TabHost implements Ways {
  readonly live: Dial = events => this.#dial("live", events);
  readonly language: Dial = events => this.#dial("language", events);
  readonly status = new Observable("Loading the simulator …");
  readonly folder: BrowserFolder = {
    files: () => [...this.#files].sort(([a], [b]) => (a < b ? -1 : 1)),
    insert: (path, text) => this.#insert(path, text),
    remove: path => this.#insert(path, null),
  };
  readonly isPublic = true;
  /** The addresses of what the program has made. */
  readonly #made = new Map<string, string>();
  /** The texts of the files by their paths. */
  readonly #files = new Map<string, string>();
  /** Searches are worth the help of others; a body of the designer is not. */
  readonly #asides = { probe: this.#aside(null), search: this.#aside(0) };
  /** The paths of files that the browser could not keep. */
  readonly #unkept = new Set<string>();
  #module: WebAssembly.Module | null = null;
  readonly #lines: { live: LineEvents | null; language: LineEvents | null } = { live: null, language: null };
  #worker: Worker | null = null;
  #prepared: () => void = () => {};
  #isReady = false;

  constructor(private readonly options: TabOptions) {
    options.files.forEach(([path, text]) => this.#files.set(path, text));
  }

  /** The address of a file that the program has made. */
  readonly file = (address: string): string => this.#made.get(address) ?? address;

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
      send: text => {
        if (name === "language" || !ASIDE.test(text) || !this.#sendAside(JSON.parse(text) as Request, text)) {
          post(worker, { say: name, text });
        }
      },
      close: () => {
        if (this.#lines[name] === events) {
          this.#lines[name] = null;
        }
      },
    };
  }

  /** Sends a request to the program beside that of the page; whether it is one of its requests. */
  #sendAside(request: Request, text: string): boolean {
    const { probe, search } = this.#asides;
    if (request.do === "cancel") {
      return probe.cancel(request.of) || search.cancel(request.of);
    }
    const place = PLACES[request.do];
    if (place === undefined || this.#module === null) {
      return false;
    }
    this.#asides[place].send(request.id, text);
    return true;
  }

  #aside(alone: number | null): Aside {
    const start = (): { worker: Worker; begin: Start } => ({
      worker: this.options.worker(),
      begin: { program: { module: this.#module! }, first: "", files: [...this.#files], keeps: false, alone },
    });
    return new Aside(start, {
      received: text => this.#lines.live?.received(text),
      wrote: (path, text) => this.#insert(path, text),
      failed: message => this.#worker !== null && this.#fail(this.#worker, message),
    });
  }

  /** Adds a file to all programs, and to those that the browser keeps; without a text, deletes it. */
  #insert(path: string, text: string | null): void {
    if (this.#worker !== null) {
      post(this.#worker, { say: "insert", path, text });
    }
    this.#note(path, text);
  }

  #showUnkept(): void {
    const paths = [...this.#unkept].join(", ");
    this.status.set(paths === "" ? "" : `This browser could not keep ${paths}: save it with Take away.`);
  }

  /** Notes a file that the program of the page has. */
  #note(path: string, text: string | null): void {
    if (text === null) {
      this.#files.delete(path);
    } else {
      this.#files.set(path, text);
    }
    Object.values(this.#asides).forEach(aside => aside.insert(path, text));
  }

  #start(): Worker {
    const worker = this.options.worker();
    worker.onmessage = ({ data }: MessageEvent<FromWorker>) => this.#receive(worker, data);
    worker.onerror = event => {
      event.preventDefault();
      this.#fail(worker, event.message ?? "the worker cannot be started");
    };
    const { first, keeps, program } = this.options;
    post(worker, { say: "begin", program: program(), first, files: [...this.#files], keeps, alone: ALONE });
    return worker;
  }

  #receive(worker: Worker, message: FromWorker): void {
    switch (message.say) {
      case "loading":
        this.status.set(`Loading the simulator: ${share(message.done, message.all)} of ${megabytes(message.all)}`);
        break;
      case "ready":
        this.#isReady = true;
        this.#module = message.module;
        message.files.forEach(([path, text]) => this.#files.set(path, text));
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
        this.#made.set(address, URL.createObjectURL(new Blob([bytes], { type })));
        const [oldest] = this.#made;
        if (oldest !== undefined && this.#made.size > MOST_MADE) {
          this.#made.delete(oldest[0]);
          URL.revokeObjectURL(oldest[1]);
        }
        break;
      }
      case "wrote":
        this.#note(message.path, message.text);
        break;
      case "kept":
        this.#unkept[message.isKept ? "delete" : "add"](message.path);
        this.#showUnkept();
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
    Object.values(this.#asides).forEach(aside => aside.close());
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
