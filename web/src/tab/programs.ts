// Where the requests of the page are done. What takes long has a program of its own, so that the page answers meanwhile
// and any work can be stopped at once. A circuit is compiled beside the swarm that is shown, and then takes its place.

import type { Request, ServerMessage } from "../protocol";
import { Aside, type Starts } from "./aside";
import type { Contents } from "./files";
import type { FromWorker } from "./messages";

type Verb = Request["do"];
type Place = "swarm" | "next" | "work" | "probe" | "search";

const PLACES: { [V in Verb]?: Place } = {
  compile: "next",
  replay: "next",
  inputs: "swarm",
  clock: "swarm",
  run: "swarm",
  pause: "swarm",
  step: "swarm",
  reset: "swarm",
  seek: "swarm",
  settle: "swarm",
  view: "swarm",
  take: "swarm",
  test: "work",
  prove: "work",
  export: "work",
  probe: "probe",
  evolve: "search",
  keep: "search",
};
/** Milliseconds in which a new swarm is alone, so that it is there soon. */
const ALONE = 1000;

export class Programs {
  #swarm: Aside | null = null;
  #next: Aside | null = null;
  readonly #work: Aside;
  readonly #probe: Aside;
  readonly #search: Aside;
  /** The request that has the newest text of the program, which others are about. */
  #program = "";

  constructor(
    private readonly starts: Starts,
    /** Takes a message of a program, with what answers it. */
    private readonly said: (message: FromWorker, from: Aside) => void,
  ) {
    const aside = (): Aside => new Aside(starts, said);
    [this.#work, this.#probe, this.#search] = [aside(), aside(), aside()];
  }

  get work(): Aside {
    return this.#work;
  }

  /** Sends a request to the program that does it, unless that is the one of the page; whether it was sent. */
  send(text: string): boolean {
    const request = JSON.parse(text) as Request;
    if (request.do === "program") {
      this.#program = text.replace(/"id":\d+/, '"id":0');
      this.prepare();
      return false;
    }
    if (request.do === "cancel") {
      return this.#cancel(request.of, text);
    }
    const place = PLACES[request.do];
    if (place === "next") {
      this.#toNext(request, text);
    } else if (place === "work") {
      this.#work.send(request.id, this.#program, text);
      this.#work.gather();
    } else if (place === "search") {
      this.#search.send(request.id, text);
      this.#search.gather();
    } else if (place === "probe") {
      this.#probe.send(request.id, text);
    } else if (place === "swarm") {
      this.#toSwarm(request.id, text);
    }
    return place !== undefined;
  }

  prepare(): void {
    this.#next ??= new Aside(this.starts, (message, from) => this.#receive(message, from));
    this.#next.begin();
  }

  insert(path: string, text: Contents | null): void {
    this.#all().forEach(aside => aside.insert(path, text));
  }

  close(): void {
    const all = this.#all();
    [this.#swarm, this.#next] = [null, null];
    all.forEach(aside => aside.close());
  }

  #all(): Aside[] {
    return [this.#swarm, this.#next, this.#work, this.#probe, this.#search].filter(aside => aside !== null);
  }

  #toNext(request: Request, text: string): void {
    this.prepare();
    this.#next?.send(request.id, this.#program, text);
    if (request.do === "replay") {
      this.#next?.gather();
    }
  }

  #toSwarm(id: number, text: string): void {
    // Without a swarm it is refused.
    const swarm = this.#swarm ?? new Aside(this.starts, this.said);
    swarm.send(id, text);
    if (swarm !== this.#swarm) {
      swarm.close();
    }
  }

  #cancel(id: number, text: string): boolean {
    // What is made of the swarm ends in its own time: the swarm stays.
    if (this.#swarm?.has(id) === true) {
      this.#swarm.post({ say: "live", text });
      return true;
    }
    return this.#all().some(aside => aside.cancel(id));
  }

  /** Takes a message of a program that compiles or shows a swarm. */
  #receive(message: FromWorker, from: Aside): void {
    const isText = message.say === "live" && typeof message.data === "string";
    if (from === this.#next && isText && isSwarm(message.data as string)) {
      const before = this.#swarm;
      [this.#swarm, this.#next] = [from, null];
      before?.close();
      setTimeout(() => from === this.#swarm && from.gather(), ALONE);
    }
    // Frames of another swarm than the one that is shown say nothing.
    if (isText || message.say !== "live" || from === this.#swarm) {
      this.said(message, from);
    } else {
      from.post({ say: "drawn" });
    }
  }
}

function isSwarm(text: string): boolean {
  const answer = JSON.parse(text) as ServerMessage;
  return "ok" in answer && "to" in answer && (answer.to === "compile" || answer.to === "replay");
}
