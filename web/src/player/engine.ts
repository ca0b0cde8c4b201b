// The engine of an exported page. It stands in the place of the server: it answers the requests about the swarm, and
// sends the same frames after each cycle.

import type { SwarmServer } from "../live/server";
import type { LoggedCycle, Poses } from "../frame";
import { Observable } from "../observable";
import { totalWidth } from "../ports";
import type { PlayEvent } from "../protocol";
import { RequestError, type Fields, type Result, type Verb } from "../request";
import { encodeFrame } from "./encode";
import type { LogicState, SwarmLogic } from "./logic";
import type { Machine } from "./machine";
import { Walkers, type WalkState } from "./walkers";

/** Cycles that can be gone back. */
const MEMORY = 1000;
/** The time between two frames, in milliseconds, and that for cycles within it. */
const FRAME_TIME = 15;
const WORK_TIME = 8;
/** A swarm that is late by more than this, in milliseconds, does not catch up. */
const LATE = 250;
/** The most cycles of a step. */
const MOST_STEPS = 1000;

/** Time as a browser has it, or a test. */
export interface Timers {
  now: () => number;
  later: (work: () => void, milliseconds: number) => void;
}

export const BROWSER: Timers = {
  now: () => performance.now(),
  later: (work, milliseconds) => void setTimeout(work, milliseconds),
};

interface Past {
  logic: LogicState;
  walk: WalkState;
  /** Nothing at the start. */
  logged: LoggedCycle | null;
}

interface Pace {
  /** Cycles a second; null for as many as can be. */
  speed: number | null;
  /** Cycles after which it pauses. */
  left: number | null;
  /** The time of the next cycle. */
  next: number;
}

export class Engine implements SwarmServer {
  onframe: (buffer: ArrayBuffer) => void = () => {};
  readonly events = new Observable<PlayEvent | null>(null);
  readonly #logic: SwarmLogic;
  readonly #walkers: Walkers;
  #inputs: number[];
  #clock: { bit: number; half: number; last: number } | null = null;
  #pace: Pace | null = null;
  /** The states after the cycles from `#first` on. */
  #past: Past[];
  #first = 0;
  /** The last cycle that the page knows. */
  #sent = 0;
  #view: number[];
  #times: number[] = [];
  #waits = false;

  constructor(
    private readonly machine: Machine,
    private readonly timers: Timers = BROWSER,
  ) {
    this.#logic = machine.logic();
    this.#walkers = new Walkers(machine);
    this.#inputs = Array.from({ length: totalWidth(machine.swarm.inputs) }, () => 0);
    this.#view = [...machine.strides.keys()];
    this.#past = [{ logic: this.#logic.state, walk: this.#walkers.state, logged: null }];
  }

  request<V extends Verb>(verb: V, fields: Fields<V>): Promise<Result<V>> {
    try {
      this.#obey(verb, fields as Record<string, unknown>);
    } catch (error) {
      return Promise.reject(error);
    }
    this.#wake(0);
    return Promise.resolve({} as Result<V>);
  }

  tell<V extends Verb>(verb: V, fields: Fields<V>): void {
    this.request(verb, fields).catch(() => {});
  }

  get #now(): number {
    return this.#logic.state.cycle;
  }

  get #last(): number {
    return this.#first + this.#past.length - 1;
  }

  #obey(verb: Verb, fields: Record<string, unknown>): void {
    switch (verb) {
      case "inputs":
        this.#setInputs([...String(fields["bits"])].map(Number));
        return;
      case "clock": {
        const { bit, half } = fields as Fields<"clock">;
        this.#clock = half === null ? null : { bit, half: Math.max(1, half), last: this.#now };
        return;
      }
      case "run":
        this.#start((fields as Fields<"run">).speed, null);
        return;
      case "pause":
        this.#pace = null;
        return;
      case "step":
        this.#start(null, Math.min(MOST_STEPS, Math.max(1, (fields as Fields<"step">).cycles)));
        return;
      case "reset":
        this.#pace = null;
        this.#restore(0);
        this.#past.length = 1;
        this.#sent = 0;
        this.#clock &&= { ...this.#clock, last: 0 };
        return;
      case "seek":
        this.#seek((fields as Fields<"seek">).cycle);
        return;
      case "view":
        this.#view = (fields as Fields<"view">).robots.filter(robot => robot in this.machine.strides);
        return;
      default:
        throw new RequestError(`this page has no server, which \`${verb}\` needs`, "alone", null, []);
    }
  }

  /** Sets the inputs, but for one that changes by itself. */
  #setInputs(bits: number[]): void {
    this.#inputs = this.#inputs.map((old, i) => (i === this.#clock?.bit ? old : (bits[i] ?? 0)));
  }

  #start(speed: number | null, left: number | null): void {
    this.#pace = { speed, left, next: this.timers.now() };
    this.#times = [];
  }

  #seek(cycle: number): void {
    if (cycle < this.#first || cycle > this.#last) {
      throw new RequestError(`cycles ${this.#first} to ${this.#last} can be shown`, null, null, []);
    }
    this.#pace = null;
    this.#restore(cycle);
    this.#clock &&= { ...this.#clock, last: cycle };
  }

  #restore(cycle: number): void {
    const past = this.#past[cycle - this.#first] ?? (this.#past[0] as Past);
    this.#logic.state = past.logic;
    this.#walkers.state = past.walk;
    if (past.logged !== null) {
      this.#inputs = [...past.logged.inputs];
    }
  }

  #wake(milliseconds: number): void {
    if (!this.#waits) {
      this.#waits = true;
      this.timers.later(() => {
        this.#waits = false;
        this.#turn();
      }, milliseconds);
    }
  }

  /** Does the cycles that are due, and sends a frame. */
  #turn(): void {
    const begun = this.timers.now();
    while (this.#pace !== null && this.#pace.next <= this.timers.now() && this.timers.now() - begun < WORK_TIME) {
      this.#cycle();
      this.#advance(this.#pace);
    }
    this.onframe(this.#frame());
    if (this.#pace !== null) {
      this.#wake(Math.max(FRAME_TIME, this.#pace.next - this.timers.now()));
    }
  }

  #advance(pace: Pace): void {
    const now = this.timers.now();
    pace.next = pace.speed === null ? now : Math.max(pace.next + 1000 / pace.speed, now - LATE);
    this.#times.push(now);
    if (this.#times.length > 64) {
      this.#times.shift();
    }
    if (pace.left !== null && --pace.left === 0) {
      this.#pace = null;
    }
  }

  #cycle(): void {
    const now = this.#now;
    if (this.#clock !== null && now >= this.#clock.last + this.#clock.half) {
      const { bit } = this.#clock;
      this.#inputs[bit] = 1 - (this.#inputs[bit] ?? 0);
      this.#clock.last = now;
    }
    this.#logic.step(this.#inputs);
    const { bits, answered } = this.#logic.state;
    this.#walkers.step(answered);
    const logged = {
      inputs: Uint8Array.from(this.#inputs),
      robots: bits,
      outputs: this.#logic.values(this.machine.swarm.shown, this.#inputs),
      places: this.#walkers.state.places,
    };
    this.#past.length = now - this.#first + 1;
    this.#past.push({ logic: this.#logic.state, walk: this.#walkers.state, logged });
    this.#sent = Math.min(this.#sent, now);
    if (this.#past.length > MEMORY + 256) {
      // Shifting them each cycle would be slow, so they are dropped in blocks.
      this.#first += this.#past.length - MEMORY;
      this.#past = this.#past.slice(-MEMORY);
    }
  }

  #frame(): ArrayBuffer {
    const from = Math.max(this.#sent, this.#first) + 1;
    const log = this.#past.slice(from - this.#first).flatMap(({ logged }) => (logged === null ? [] : [logged]));
    const poses = new Map<number, Poses>();
    this.#view.forEach(robot => poses.set(robot, this.#walkers.poses(robot, this.#now)));
    this.#sent = this.#last;
    const frame = {
      posesPerCycle: this.machine.swarm.frames,
      robots: this.machine.strides.length,
      now: this.#now,
      first: this.#first,
      last: this.#last,
      rate: this.#rate(),
      running: this.#pace !== null,
      from,
      log,
      poses,
    };
    return encodeFrame(frame, this.machine.swarm.number);
  }

  /** Cycles a second over the last cycles. */
  #rate(): number {
    const [first, last] = [this.#times[0], this.#times.at(-1)];
    if (this.#pace === null || first === undefined || last === undefined || last <= first) {
      return 0;
    }
    return (1000 * (this.#times.length - 1)) / (last - first);
  }
}
