// What a page and the worker with its program say to each other.

/** Where the program is: an address, or its bytes, compressed by gzip. */
export type Source = { address: string; bytes: number } | { packed: ArrayBuffer };

/** What the program begins with. */
export interface Start {
  /** The file that the page opens first; empty for none in particular. */
  first: string;
  /** Files that the page comes with. */
  files: [path: string, text: string][];
  /** Whether the browser keeps files. */
  keeps: boolean;
}

export type ToWorker =
  | ({ say: "begin"; program: Source } & Start)
  | { say: "live" | "language"; text: string }
  | { say: "greet" }
  /** The address of the page that live exports are made of. */
  | { say: "template"; address: string }
  /** The last frame was drawn. */
  | { say: "drawn" }
  /** To a worker that only simulates parts of cycles for another. */
  | { say: "assist"; module: WebAssembly.Module }
  | { say: "part"; number: number; bytes: ArrayBuffer };

export type FromWorker =
  | { say: "loading"; done: number; all: number }
  | { say: "ready"; keeps: boolean }
  | { say: "live"; data: string | ArrayBuffer }
  | { say: "language"; text: string }
  | { say: "template" }
  /** A file was saved, but the browser did not keep it. */
  | { say: "unkept"; path: string }
  /** An assistant is ready, or has simulated a part. */
  | { say: "assisting" }
  | { say: "part"; number: number; bytes: ArrayBuffer }
  | { say: "file"; address: string; type: string; bytes: ArrayBuffer }
  /** The program has failed, or could not be loaded; nothing more will come. */
  | { say: "failed"; message: string };
