// The program in a worker of the page. One that has failed is replaced: the page then says again what it works on.

import type { BrowserFolder, Dial, LineEvents, Ways } from "../line";
import { Observable } from "../observable";
import type { Aside } from "./aside";
import { Assistants } from "./assistants";
import type { Contents } from "./files";
import type { FromWorker, LiveParts, Source, Start, ToWorker } from "./messages";
import { MadeFiles } from "./made";
import { Programs } from "./programs";
import { Texts } from "./texts";

export interface TabOptions extends Omit<Start, "program"> {
  worker: () => Worker;
  program: () => Source;
  /** The addresses of what live exports are made of, if they can be made. */
  template?: LiveParts;
}

const KEEPS_NOTHING = "This browser keeps no files: save what you need from Share.";

export class TabHost implements Ways {
  readonly live: Dial = events => this.#dial("live", events);
  readonly language: Dial = events => this.#dial("language", events);
  readonly status = new Observable("Loading the simulator …");
  readonly folder: BrowserFolder = {
    files: () => this.#texts.all,
    insert: (path, text) => this.#insert(path, text),
    remove: path => this.#insert(path, null),
  };
  readonly isPublic = true;
  readonly #made = new MadeFiles();
  readonly #texts = new Texts();
  readonly #programs = new Programs(
    {
      program: () => this.#started({ module: this.#module! }, "", false),
      assistants: lead => new Assistants(this.#module!, this.options.worker, lead),
    },
    (message, from) => this.#receive(from, message),
  );
  #module: WebAssembly.Module | null = null;
  readonly #lines: { live: LineEvents | null; language: LineEvents | null } = { live: null, language: null };
  #worker: Worker | null = null;
  #prepared: () => void = () => {};
  #isReady = false;

  constructor(private readonly options: TabOptions) {
    options.files.forEach(file => this.#texts.note(...file));
  }

  readonly file = (address: string): string => this.#made.address(address);

  prepare(): Promise<void> {
    const { template } = this.options;
    if (template === undefined || !this.#isReady) {
      return Promise.resolve();
    }
    return new Promise(resolve => {
      this.#prepared = resolve;
      this.#programs.work.post({ say: "template", ...template });
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
        if (name === "language" || !this.#isReady || !this.#programs.send(text)) {
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

  /** Adds a file to all programs, and to those that the browser keeps; without contents, deletes it. */
  #insert(path: string, text: Contents | null): void {
    if (this.#worker !== null) {
      post(this.#worker, { say: "insert", path, text });
    }
    this.#note(path, text);
  }

  #note(path: string, text: Contents | null): void {
    this.#texts.note(path, text);
    this.#programs.insert(path, text);
  }

  #start(): Worker {
    const { first, keeps, program } = this.options;
    const worker = this.#started(program(), first, keeps);
    worker.onmessage = ({ data }: MessageEvent<FromWorker>) => this.#receive(worker, data);
    return worker;
  }

  #started(program: Source, first: string, keeps: boolean): Worker {
    const worker = this.options.worker();
    worker.onerror = event => {
      event.preventDefault();
      this.#fail(event.message ?? "the worker cannot be started");
    };
    post(worker, { say: "begin", program, first, files: this.#texts.all, keeps });
    return worker;
  }

  /** Takes a message of the program of the page, or of one beside it. */
  #receive(from: Worker | Aside, message: FromWorker): void {
    switch (message.say) {
      case "loading": {
        const part = Math.min(100, Math.round((100 * message.done) / message.all));
        this.status.set(`Loading the simulator: ${part} % of ${(message.all / 1e6).toFixed(1)} MB`);
        break;
      }
      case "ready":
        if (from !== this.#worker) {
          break;
        }
        this.#isReady = true;
        this.#module = message.module;
        message.files.forEach(file => this.#texts.note(...file));
        this.status.set(message.keeps || !this.options.keeps ? "" : KEEPS_NOTHING);
        this.#programs.prepare();
        this.#lines.live?.opened();
        this.#lines.language?.opened();
        break;
      case "live":
        this.#lines.live?.received(message.data);
        if (typeof message.data !== "string" && !(from instanceof Worker)) {
          from.post({ say: "drawn" });
        }
        break;
      case "language":
        this.#lines.language?.received(message.text);
        break;
      case "template":
        this.#prepared();
        break;
      case "file":
        this.#made.add(message.address, message.type, message.bytes);
        break;
      case "wrote":
        if (from === this.#worker) {
          this.#note(message.path, message.text);
        } else {
          this.#insert(message.path, message.text);
        }
        break;
      case "kept":
        this.status.set(this.#texts.noteKept(message.path, message.isKept));
        break;
      case "failed":
        this.#fail(message.message);
        break;
    }
  }

  #fail(message: string): void {
    if (this.#worker === null) {
      return;
    }
    this.#worker.terminate();
    this.#worker = null;
    this.#programs.close();
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
