// The program that is edited: its text and file, what is wrong with it, and the swarm that is compiled from it.

import { CANCELLED, LOST, type Connection } from "./connection";
import { Drafts, type Draft } from "./editor/draft";
import type { LiveSwarm } from "./live/swarm";
import { Observable } from "./observable";
import type { CircuitEntry, FileText, Greeting, ProgramReport } from "./protocol";
import { freePath } from "./free_path";
import { RequestError } from "./request";
import { sameProgram } from "./sameness";

export interface Choice {
  circuit: string;
  swarm: string | null;
}

export type Stage =
  | { state: "idle" | "checking" | "ready" }
  | { state: "compiling"; circuit: string }
  | { state: "errors"; count: number }
  | { state: "failed"; message: string; help: string | null };

export type Origin = { path: string } | { example: string };

const PAUSE = 350;

export class Program {
  readonly path = new Observable("");
  readonly checked = new Observable<ProgramReport | null>(null);
  readonly choice = new Observable<Choice | null>(null);
  readonly stage = new Observable<Stage>({ state: "idle" });
  readonly unsaved = new Observable(false);
  /** The program that was saved last: its path before, and where it is now. */
  readonly saved = new Observable<{ from: string; path: string } | null>(null);
  /** The program whose draft another tab has changed, and where this tab goes on with it. */
  readonly forked = new Observable<{ from: string; path: string } | null>(null);
  /** The stamp of the file, null while there is none. */
  stamp: string | null = null;
  /** What is shown first, on a page that was made of one circuit. */
  preferred: Choice | null = null;
  plays = true;
  hello: Greeting | null = null;
  readonly drafts = new Drafts(() => this.folder);
  #text = "";
  #checkedText: string | null = null;
  #saved: string | null = null;
  /** Whether neither a file nor an example has the program, so that a reload needs its draft. */
  #alone = false;
  #compiled: { path: string; text: string; choice: string } | null = null;
  shown: string | null = null;
  #timer = 0;
  #edited = false;
  #checking: Promise<void> = Promise.resolve();
  #compilation: AbortController | null = null;
  #turn = 0;

  constructor(
    private readonly connection: Connection,
    private readonly swarm: LiveSwarm,
  ) {}

  get text(): string {
    return this.#text;
  }

  get isChecked(): boolean {
    return this.#checkedText === this.#text;
  }

  get uri(): string {
    const root = this.hello?.root ?? "file:///";
    return `${root.replace(/\/?$/, "/")}${this.path.value.split("/").map(encodeURIComponent).join("/")}`;
  }

  get folder(): string {
    return this.hello?.root ?? "";
  }

  /**
   * Takes a file's text, or one that is `alone`: no file or example has it. The result is the draft that is shown in
   * its place, if there is one.
   */
  begin(file: FileText, alone = false): Draft | null {
    const draft = this.drafts.open(file.path);
    const isTouched = draft !== null && draft.untouched !== true;
    const restored = isTouched && draft.text !== file.text ? draft : null;
    this.#alone = alone;
    if (alone && !isTouched) {
      this.drafts.keep(file.path, { text: file.text, stamp: null, untouched: true });
    }
    this.path.set(file.path);
    if (this.shown !== file.path && this.swarm.wantsToRun) {
      this.plays = true;
      this.swarm.pause();
    }
    // A draft of an older file must not replace the present one.
    this.stamp = restored === null || file.stamp === null ? file.stamp : restored.stamp;
    this.#saved = alone && isTouched ? null : file.text;
    this.#text = restored?.text ?? file.text;
    this.unsaved.set(this.#text !== this.#saved);
    this.checked.set(null);
    this.choice.set(null);
    this.#check();
    return restored;
  }

  /** Takes a text that has no file, such as that of a link, as a draft, and the circuit to show if there is such a one. */
  beginDraft(path: string, text: string, choice: Choice | null): void {
    this.drafts.open(path);
    this.drafts.keep(path, { text, stamp: null });
    this.begin({ path, text, stamp: null }, true);
    this.#saved = null;
    this.unsaved.set(true);
    this.choice.set(choice);
  }

  /** Whether the unsaved text of the present program can be had back after another one was opened. */
  get isKept(): boolean {
    return !this.unsaved.value || this.drafts.of(this.path.value)?.text === this.#text;
  }

  /** Notes the file's present text, which the editor is about to show. */
  adopt(file: FileText): void {
    this.path.set(file.path);
    this.stamp = file.stamp;
    this.#saved = file.text;
    this.#alone = false;
  }

  edit(text: string): void {
    this.#text = text;
    const unsaved = text !== this.#saved;
    this.unsaved.set(unsaved);
    const untouched = unsaved ? {} : { untouched: true };
    const draft = unsaved || this.#alone ? { text, stamp: this.stamp, ...untouched } : null;
    if (!this.drafts.keep(this.path.value, draft)) {
      this.#fork();
    }
    clearTimeout(this.#timer);
    this.#edited = true;
    this.#timer = window.setTimeout(() => this.#check(), PAUSE);
  }

  /** Waits until the present text has been checked. An edit of just now is checked at once. */
  async settled(): Promise<void> {
    if (this.#edited) {
      this.#check();
    }
    for (let known; known !== this.#checking; ) {
      known = this.#checking;
      await known;
    }
  }

  /** Goes on under a name of its own: the draft of this one is now that of another tab. */
  #fork(): void {
    const from = this.path.value;
    const path = freePath(from, name => this.isTaken(name));
    this.#alone = true;
    this.#saved = null;
    this.stamp = null;
    this.unsaved.set(true);
    this.#move(path);
    this.drafts.keep(path, { text: this.#text, stamp: null });
    this.forked.set({ from, path });
  }

  isTaken(path: string): boolean {
    const { files = [], examples = [] } = this.hello ?? {};
    const isNamed = files.some(file => file.path === path) || examples.some(({ name }) => name === path);
    return isNamed || this.drafts.of(path) !== null;
  }

  /** Notes that the program is at another path from now on. */
  #move(path: string): void {
    this.shown = this.shown === this.path.value ? path : this.shown;
    this.path.set(path);
  }

  async save(path = this.path.value, stamp = path === this.path.value ? this.stamp : null): Promise<void> {
    const text = this.#text;
    const saved = await this.connection.request("save", { path, text, stamp });
    const from = this.path.value;
    this.drafts.keep(from, null);
    this.#move(path);
    this.stamp = saved.stamp;
    this.#saved = text;
    this.#alone = false;
    this.unsaved.set(this.#text !== text);
    this.saved.set({ from, path });
  }

  choose(choice: Choice): void {
    this.choice.set(choice);
    void this.#compile();
  }

  cancel(): void {
    this.#compilation?.abort();
  }

  /** Tells a server that has just been found again what this page works on. */
  restore(): void {
    this.#compiled = null;
    this.plays = this.swarm.wantsToRun || this.plays;
    this.#check();
  }

  /** Notes that the swarm is now another than that of the program, such as that of a replay. */
  forgetCompiled(choice: Choice | null): void {
    this.#compiled = null;
    this.shown = this.path.value;
    this.choice.set(choice);
  }

  /** The circuits that can be compiled, with those of tests and claims, which give parameters. */
  circuits(): CircuitEntry[] {
    const checked = this.checked.value;
    const entries = [...(checked?.circuits ?? [])];
    for (const { circuit, line } of [...(checked?.tests ?? []), ...(checked?.claims ?? [])]) {
      if (!entries.some(entry => entry.circuit === circuit)) {
        entries.push({ name: circuit, circuit, swarms: [], line });
      }
    }
    return entries;
  }

  #check(): void {
    clearTimeout(this.#timer);
    this.#edited = false;
    this.#checking = this.#checkNow();
  }

  async #checkNow(): Promise<void> {
    const turn = ++this.#turn;
    const [path, text] = [this.path.value, this.#text];
    this.stage.set({ state: "checking" });
    try {
      const checked = await this.connection.request("program", { path, text });
      if (turn === this.#turn) {
        this.#checkedText = text;
        this.checked.set(checked);
        this.#proceed(checked);
      }
    } catch (error) {
      if (turn === this.#turn) {
        this.#fail(error);
      }
    }
  }

  #proceed(checked: ProgramReport): void {
    if (checked.errors > 0) {
      this.stage.set({ state: "errors", count: checked.errors });
      return;
    }
    const circuits = this.circuits();
    const wanted = this.choice.value ?? this.preferred;
    const kept = circuits.find(entry => entry.circuit === wanted?.circuit);
    // A test is about the circuit that matters; without one the last circuit uses the others.
    const first = circuits.find(entry => entry.circuit === checked.tests[0]?.circuit) ?? circuits.at(-1);
    if (first === undefined) {
      this.choice.set(null);
      this.stage.set({ state: "ready" });
      return;
    }
    const swarm = kept?.swarms.includes(wanted?.swarm ?? "") ? (wanted?.swarm ?? null) : null;
    const choice = { circuit: (kept ?? first).circuit, swarm };
    if (JSON.stringify(choice) !== JSON.stringify(this.choice.value)) {
      this.choice.set(choice);
    }
    void this.#compile();
  }

  async #compile(): Promise<void> {
    const choice = this.choice.value;
    const [path, text] = [this.path.value, this.#text];
    if (choice === null || this.#isCompiled(path, text, choice)) {
      this.stage.set({ state: "ready" });
      return;
    }
    this.#compilation?.abort();
    const compilation = new AbortController();
    this.#compilation = compilation;
    this.stage.set({ state: "compiling", circuit: choice.circuit });
    try {
      const { swarm } = await this.connection.request("compile", { path, ...choice }, { signal: compilation.signal });
      if (this.#compilation === compilation) {
        this.#compiled = { path, text, choice: JSON.stringify(choice) };
        this.#start(swarm, path);
      }
    } catch (error) {
      if (this.#compilation === compilation) {
        this.#fail(error);
      }
    }
  }

  #isCompiled(path: string, text: string, choice: Choice): boolean {
    const compiled = this.#compiled;
    return (
      compiled !== null &&
      compiled.path === path &&
      compiled.choice === JSON.stringify(choice) &&
      sameProgram(compiled.text, text)
    );
  }

  #start(swarm: Parameters<LiveSwarm["begin"]>[0], path: string): void {
    const plays = this.plays || this.swarm.wantsToRun;
    this.plays = false;
    this.shown = path;
    this.swarm.begin(swarm);
    this.stage.set({ state: "ready" });
    if (plays) {
      this.swarm.play();
    }
  }

  #fail(error: unknown): void {
    if (error instanceof RequestError && error.code === LOST) {
      return;
    }
    if (error instanceof RequestError && error.code === CANCELLED) {
      this.stage.set({ state: "failed", message: "compiling was stopped", help: null });
    } else if (error instanceof RequestError) {
      const [diagnostic] = error.diagnostics;
      const message = diagnostic === undefined ? error.message : diagnostic.message;
      this.stage.set({ state: "failed", message, help: error.help ?? diagnostic?.help ?? null });
    } else {
      throw error;
    }
  }
}
