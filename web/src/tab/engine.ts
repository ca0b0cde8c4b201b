// The program as WebAssembly: the functions of crates/web/src/exports.rs as a script calls them.

import type { Contents } from "./files";

export type EngineMessage =
  | { kind: "page"; data: string | ArrayBuffer }
  | { kind: "language"; text: string }
  | { kind: "written"; path: string; text: string }
  | { kind: "kept"; address: string; type: string; bytes: ArrayBuffer }
  | { kind: "part"; number: number; bytes: ArrayBuffer };

interface Exports {
  memory: WebAssembly.Memory;
  begin: (first: number, length: number, now: number) => void;
  template: (place: number, length: number) => void;
  room: (length: number) => number;
  remove: (path: number, length: number) => void;
  insert: (path: number, pathLength: number, place: number, length: number) => void;
  receive: (place: number, length: number, now: number) => void;
  greet: () => void;
  crew: (size: number) => void;
  receive_part: (number: number, place: number, length: number) => void;
  simulate: (place: number, length: number) => void;
  receive_language: (place: number, length: number, now: number) => void;
  advance: (now: number) => number;
  next: (hasRoom: boolean) => number;
  part: (number: number) => number;
  part_length: (number: number) => number;
}

export class Engine {
  readonly #exports: Exports;
  readonly #encoder = new TextEncoder();
  readonly #decoder = new TextDecoder();

  private constructor(instance: WebAssembly.Instance) {
    this.#exports = instance.exports as unknown as Exports;
  }

  /**
   * Starts a compiled program. `failed` receives the message of a panic after `begin`; after any panic the engine is of
   * no use.
   */
  static async start(module: WebAssembly.Module, failed: (message: string) => void): Promise<Engine> {
    let memory: WebAssembly.Memory | undefined;
    const fail = (place: number, length: number): void => {
      failed(new TextDecoder().decode(new Uint8Array(memory!.buffer, place, length)));
    };
    const instance = await WebAssembly.instantiate(module, { page: { fail } });
    memory = instance.exports["memory"] as WebAssembly.Memory;
    return new Engine(instance);
  }

  /** Begins the program of a page, which opens `first` if that is not empty. */
  begin(first: string, now: number): void {
    this.#exports.begin(...this.#put(first), now);
  }

  crew(size: number): void {
    this.#exports.crew(size);
  }

  receivePart(number: number, bytes: ArrayBuffer): void {
    this.#exports.receive_part(number, ...this.#putBytes(new Uint8Array(bytes)));
  }

  /** Does a part of a simulation for another engine. Needs no `begin`. */
  simulate(bytes: ArrayBuffer): ArrayBuffer {
    this.#exports.simulate(...this.#putBytes(new Uint8Array(bytes)));
    return this.#bytes(0);
  }

  /** Adds a file, or replaces it; without contents, deletes it. */
  insert(path: string, text: Contents | null): void {
    if (text === null) {
      this.#exports.remove(...this.#put(path));
    } else {
      this.#exports.insert(...this.#put(path), ...(typeof text === "string" ? this.#put(text) : this.#putBytes(text)));
    }
  }

  template(text: string): void {
    this.#exports.template(...this.#put(text));
  }

  receive(text: string, now: number): void {
    this.#exports.receive(...this.#put(text), now);
  }

  greet(): void {
    this.#exports.greet();
  }

  receiveLanguage(text: string, now: number): void {
    this.#exports.receive_language(...this.#put(text), now);
  }

  /** Does a portion of what is due; milliseconds until there is more to do. */
  advance(now: number): number {
    return this.#exports.advance(now);
  }

  /** The next message. A frame waits until there is room for it. */
  next(hasRoom: boolean): EngineMessage | null {
    switch (this.#exports.next(hasRoom)) {
      case 1:
        return { kind: "page", data: this.#text(0) };
      case 2:
        return { kind: "page", data: this.#bytes(0) };
      case 3:
        return { kind: "language", text: this.#text(0) };
      case 4:
        return { kind: "written", path: this.#text(0), text: this.#text(1) };
      case 5:
        return { kind: "kept", address: this.#text(0), type: this.#text(1), bytes: this.#bytes(2) };
      case 6:
        return { kind: "part", number: Number(this.#text(0)), bytes: this.#bytes(1) };
      default:
        return null;
    }
  }

  #put(text: string): [number, number] {
    return this.#putBytes(this.#encoder.encode(text));
  }

  #putBytes(bytes: Uint8Array): [number, number] {
    const place = this.#exports.room(bytes.length);
    // The memory moves when it grows, so it is looked up each time.
    new Uint8Array(this.#exports.memory.buffer, place, bytes.length).set(bytes);
    return [place, bytes.length];
  }

  #view(number: number): Uint8Array<ArrayBuffer> {
    const buffer = this.#exports.memory.buffer as ArrayBuffer;
    return new Uint8Array(buffer, this.#exports.part(number), this.#exports.part_length(number));
  }

  #text(number: number): string {
    return this.#decoder.decode(this.#view(number));
  }

  #bytes(number: number): ArrayBuffer {
    return this.#view(number).slice().buffer;
  }
}
