// The swarm of this session: what it consists of, where its run is, and the requests that drive it.

import type { Connection } from "../connection";
import { CYCLE_STEPS, decodeFrame, isFrameOf, type Frame } from "../frame";
import { RunLog } from "../log";
import { Observable } from "../observable";
import { bitsOf, keepBits, totalWidth, withBit } from "../ports";
import type { StimulusSource, ShownSwarm } from "../protocol";
import type { Fields } from "../request";
import { Selection } from "../selection";
import { Playback } from "./playback";
import { threadAt } from "./waves";

export interface AutomaticClock {
  bit: number;
  half: number;
}

/** Real time: a cycle is a quarter of a second. */
export const REAL_TIME = 4;

export class LiveSwarm {
  readonly definition = new Observable<ShownSwarm | null>(null);
  readonly frame = new Observable<Frame | null>(null);
  readonly log = new RunLog();
  readonly playback = new Playback();
  readonly selection = new Selection();
  /** The input bits that are wanted from the next cycle on. */
  readonly inputs = new Observable("");
  readonly clock = new Observable<AutomaticClock | null>(null);
  /** The cycles whose inputs a test gives, until somebody sets inputs; 0 where there is no test. */
  readonly scripted = new Observable(0);
  /** Cycles a second; null is as fast as possible. */
  readonly speed = new Observable<number | null>(REAL_TIME);
  readonly running = new Observable(false);
  readonly stopped = new Observable<string | null>(null);
  /** The numbers of robots, inputs and outputs of each net by its name. */
  nets = new Map<string, StimulusSource>();
  /** Orders to run or to stop that have no answer yet; until then frames are about the time before them. */
  #orders = 0;
  #early: ArrayBuffer | null = null;
  #shown: number[] | null = null;
  /** The cycle whose inputs become those of the next one, as soon as a frame says what they are; or any cycle. */
  #adopted: number | "any" | null = null;
  #watched = true;
  #proposed: ((swarm: ShownSwarm) => string | null) | null = null;
  #rests = false;

  constructor(private readonly server: Connection) {
    server.onframe = buffer => this.#receive(buffer);
    server.events.on(event => {
      if (event?.event === "stopped") {
        this.stopped.set(event.reason);
        this.running.set(false);
      }
    });
  }

  /** Takes a swarm that was just compiled. Inputs of the same name keep their values, unless a replay set them. */
  begin(swarm: ShownSwarm, replayed = false): void {
    const before = this.definition.value;
    const kept = replayed
      ? "0".repeat(totalWidth(swarm.inputs))
      : (this.#proposed?.(swarm) ?? keepBits(this.inputs.value, before?.inputs ?? [], swarm.inputs));
    this.#proposed = null;
    const clock = this.#keptClock(before, swarm);
    this.#forget();
    this.nets = netsOf(swarm);
    this.inputs.set(kept);
    this.scripted.set(swarm.script?.cycles ?? 0);
    this.definition.set(swarm);
    this.#adopted = replayed ? "any" : null;
    this.setClock(replayed ? null : clock);
    if (!replayed) {
      this.server.tell("inputs", { bits: kept });
    }
    const early = this.#early;
    this.#early = null;
    if (early !== null) {
      this.#receive(early);
    }
  }

  /** The input bits of the swarm that is compiled next, in the place of those of the swarm before. */
  propose(inputs: (swarm: ShownSwarm) => string | null): void {
    this.#proposed = inputs;
  }

  /** What the outputs are for rows of inputs once all robots have settled; null for a swarm with a state. */
  async settled(rows: string[]): Promise<string[] | null> {
    const answer = await this.server.request("settle", { rows }).catch(() => null);
    return answer?.outputs ?? null;
  }

  setBit(index: number, bit: number): void {
    this.setInputs(withBit(this.inputs.value, index, bit));
  }

  setInputs(bits: string): void {
    this.#adopted = null;
    if (bits !== this.inputs.value) {
      this.scripted.set(0);
      this.inputs.set(bits);
      this.server.tell("inputs", { bits });
    }
  }

  setClock(clock: AutomaticClock | null): void {
    const before = this.clock.value;
    if (before !== null && before.bit !== clock?.bit) {
      this.server.tell("clock", { bit: before.bit, half: null });
    }
    if (clock !== null) {
      this.scripted.set(0);
      this.server.tell("clock", { ...clock });
    }
    this.clock.set(clock);
  }

  play(): void {
    this.#rests = !this.#watched;
    if (this.#watched && this.definition.value !== null && this.stopped.value === null) {
      void this.#drive(true, "run", { speed: this.speed.value });
    }
  }

  /** Whether it runs, or will as soon as somebody looks. */
  get wantsToRun(): boolean {
    return this.running.value || this.#rests;
  }

  watch(watched: boolean): void {
    const wanted = this.wantsToRun;
    this.#watched = watched;
    if (!watched && wanted) {
      this.pause();
      this.#rests = true;
    } else if (watched && this.#rests) {
      this.play();
    }
  }

  pause(): void {
    this.#rests = false;
    void this.#drive(false, "pause", {});
  }

  setSpeed(speed: number | null): void {
    this.speed.set(speed);
    if (this.running.value) {
      void this.#drive(true, "run", { speed });
    }
  }

  step(cycles = 1): void {
    void this.#drive(false, "step", { cycles });
  }

  reset(): void {
    this.stopped.set(null);
    this.#adopted = null;
    this.log.clear();
    void this.#drive(false, "reset", {});
  }

  /** Shows an earlier moment, whose inputs become those of the next cycle. The program takes them over, too. */
  seek(cycle: number): Promise<boolean> {
    this.stopped.set(null);
    const logged = this.log.at(cycle);
    this.#adopted = logged === undefined && cycle > 0 ? cycle : null;
    if (logged !== undefined) {
      this.inputs.set([...logged.inputs].join(""));
    }
    return this.#drive(false, "seek", { cycle });
  }

  view(robots: number[]): void {
    if (this.#shown?.join() !== robots.join()) {
      this.#shown = robots;
      this.server.tell("view", { robots });
    }
  }

  /** The value of a source in the cycle that is shown; null before the first. */
  value(source: StimulusSource | undefined, cycle = this.playback.cycle): number | null {
    if (source === undefined) {
      return null;
    }
    if ("constant" in source) {
      return Number(source.constant);
    }
    const logged = this.log.at(cycle);
    if ("input" in source) {
      return logged?.inputs[source.input] ?? Number(this.inputs.value[source.input] ?? 0);
    }
    return logged?.robots[source.robot] ?? null;
  }

  /** The moments within a cycle at which one of these changed: from `cycle` to `cycle + 1`. */
  edges(sources: StimulusSource[], cycle: number): number[] {
    const robots = sources.flatMap(source => ("robot" in source ? [source.robot] : []));
    const own = this.log.at(cycle)?.flips.filter(([robot]) => robots.includes(robot)) ?? [];
    return [...new Set(own.map(([, after]) => cycle + after))];
  }

  /** The value of a source at such a moment: a robot with a clock of its own has the one before until it changes. */
  valueAt(source: StimulusSource, time: number): number | null {
    const cycle = Math.floor(time);
    const logged = this.log.at(cycle);
    if (!("robot" in source) || logged === undefined || this.definition.value?.own_clocks.length === 0) {
      return this.value(source, cycle);
    }
    const before = this.value(source, cycle - 1) ?? 0;
    return logged.flips.reduce(
      (bit, [at, after]) => bit ^ Number(at === source.robot && cycle + after <= time),
      before,
    );
  }

  /** The share of its own cycle that a robot has done at the shown moment; null with a common clock. */
  ownCycle(robot: number): number | null {
    const [ahead, faster] = this.definition.value?.own_clocks[robot] ?? [];
    if (ahead === undefined || faster === undefined) {
      return null;
    }
    const cycles = this.playback.time * (1 + faster / 1e6) + ahead / CYCLE_STEPS;
    return cycles - Math.floor(cycles);
  }

  /** The thread whose wave a source carries in the cycle that is shown; null where there is but one, or none. */
  thread(source: StimulusSource, cycle = this.playback.cycle): number | null {
    const waves = this.definition.value?.waves ?? null;
    return waves !== null && waves.threads > 1 && "robot" in source ? threadAt(waves, source.robot, cycle) : null;
  }

  nameOf(source: StimulusSource): string {
    const definition = this.definition.value;
    if ("constant" in source) {
      return String(Number(source.constant));
    }
    if ("robot" in source) {
      return definition?.robots[source.robot]?.label ?? "";
    }
    return bitsOf(definition?.inputs ?? [])[source.input]?.name ?? "";
  }

  #receive(buffer: ArrayBuffer): void {
    const swarm = this.definition.value;
    if (swarm === null || !isFrameOf(buffer, swarm)) {
      // The first frame of a swarm may overtake the answer that says what it consists of.
      this.#early = buffer;
      return;
    }
    const frame = decodeFrame(buffer, totalWidth(swarm.inputs), totalWidth(swarm.outputs));
    this.log.merge(frame);
    this.playback.push(frame);
    if (this.#orders === 0) {
      this.running.set(frame.running);
    }
    this.#adoptInputs(frame);
    this.frame.set(frame);
  }

  #drive<V extends "run" | "pause" | "step" | "reset" | "seek">(
    running: boolean,
    verb: V,
    fields: Fields<V>,
  ): Promise<boolean> {
    this.running.set(running);
    this.#rests &&= running;
    this.#orders++;
    const answered = this.server.request(verb, fields).finally(() => this.#orders--);
    return answered.then(Boolean, () => false);
  }

  #adoptInputs(frame: Frame): void {
    const logged = this.log.at(frame.now);
    const awaited = this.#adopted === "any" || this.#adopted === frame.now;
    const isGiven = this.scripted.value > 0 && frame.now <= this.scripted.value;
    if ((isGiven || (awaited && !frame.running)) && logged !== undefined) {
      this.#adopted = isGiven ? this.#adopted : null;
      this.inputs.set([...logged.inputs].join(""));
    }
  }

  #keptClock(before: ShownSwarm | null, swarm: ShownSwarm): AutomaticClock | null {
    const clock = this.clock.value;
    const name = clock === null || before === null ? null : bitsOf(before.inputs)[clock.bit]?.name;
    const bit = bitsOf(swarm.inputs).find(other => other.name === name);
    return clock === null || bit === undefined || bit.index === swarm.waves?.clock
      ? null
      : { bit: bit.index, half: clock.half };
  }

  #forget(): void {
    this.clock.set(null);
    this.log.clear();
    this.playback.clear();
    this.selection.clear();
    this.frame.set(null);
    this.stopped.set(null);
    this.running.set(false);
    this.#rests = false;
    this.#shown = null;
  }
}

export function netsOf(swarm: ShownSwarm): Map<string, StimulusSource> {
  const nets = new Map<string, StimulusSource>();
  swarm.robots.forEach((robot, index) => nets.set(robot.net, { robot: index }));
  bitsOf(swarm.outputs).forEach((bit, i) => nets.set(bit.name, swarm.shown[i] ?? { constant: false }));
  bitsOf(swarm.inputs).forEach(bit => nets.set(bit.name, { input: bit.index }));
  return nets;
}
