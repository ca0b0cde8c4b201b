// What a page and the worker with its program say to each other.

import type { Contents, KeptFiles } from "./files";

/** Where the program is: an address, or its bytes, compressed by gzip; or what another worker has compiled. */
export type Source = { address: string; bytes: number } | { packed: ArrayBuffer } | { module: WebAssembly.Module };

export interface Start {
  program: Source;
  /** The file that the page opens first; empty for none in particular. */
  first: string;
  files: KeptFiles;
  keeps: boolean;
}

/** The addresses of the page that live exports are made of, and of the program that is put into it. */
export interface LiveParts {
  page: string;
  program: string;
}

/** A part of a simulation, or what became of it. */
export interface Part {
  number: number;
  bytes: ArrayBuffer;
}

/** What an assistant says: that it is ready, and then what became of each part. */
export type FromAssistant = "ready" | Part;

export type ToWorker =
  | ({ say: "begin" } & Start)
  | { say: "live" | "language"; text: string }
  | { say: "greet" }
  /** Assistants simulate from now on, one at each port; without ports, none. */
  | { say: "crew"; ports: MessagePort[] }
  /** A file that was written elsewhere, or deleted if it has no contents. */
  | { say: "insert"; path: string; text: Contents | null }
  | ({ say: "template" } & LiveParts)
  | { say: "drawn" }
  /** To a worker that only does parts of simulations for another. */
  | { say: "assist"; module: WebAssembly.Module; port: MessagePort };

export type FromWorker =
  | { say: "loading"; done: number; all: number }
  | { say: "ready"; keeps: boolean; module: WebAssembly.Module; files: KeptFiles }
  | { say: "live"; data: string | ArrayBuffer }
  | { say: "language"; text: string }
  | { say: "template" }
  /** A file was saved here, or by another tab, which may have deleted it. */
  | { say: "wrote"; path: string; text: Contents | null }
  | { say: "kept"; path: string; isKept: boolean }
  | { say: "file"; address: string; type: string; bytes: ArrayBuffer }
  /** The program has failed, or could not be loaded; nothing more will come. */
  | { say: "failed"; message: string };
