// The messages between this page and its server, as docs/play-protocol.md describes them.

export interface Hello {
  version: string;
  folder: string;
  root: string;
  file: string | null;
  files: FileEntry[];
  examples: Example[];
  limits: { robots: number; cycles: number; message: number };
  cycle_seconds: number;
}

export interface FileEntry {
  path: string;
  size: number;
}
export interface Example {
  name: string;
  about: string;
}
export interface FileText {
  path: string;
  text: string;
  stamp: string | null;
}

export interface Port {
  name: string;
  width: number;
}

export interface CircuitEntry {
  name: string;
  circuit: string;
  swarms: string[];
  line: number;
}

export interface TestRow {
  row: number;
  line: number;
  inputs: string[];
  outputs: string[];
}

export interface TestEntry {
  index: number;
  circuit: string;
  title: string;
  line: number;
  rows: TestRow[];
  inputs: Port[];
  outputs: Port[];
}

export interface Place {
  byte: number;
  line: number;
  column: number;
}
export interface Label {
  file: string;
  start: Place;
  end: Place;
  text: string;
}

export interface Diagnostic {
  code: string;
  severity: "error" | "warning" | "note";
  message: string;
  help: string | null;
  labels: Label[];
}

export interface Checked {
  errors: number;
  diagnostics: Diagnostic[];
  circuits: CircuitEntry[];
  tests: TestEntry[];
}

/** Where a bit comes from. */
export type Source = { input: number } | { robot: number } | { constant: boolean | number };

/** The numbers of the corner points around a voxel, and its index in the looks. */
export type Voxel = [number, number, number, number, number];

export interface Robot {
  net: string;
  function: string;
  robot: string;
  about: [string, string][] | string;
  senses: Source[];
  body: string[];
  size: [number, number];
  voxels: Voxel[];
  points: number;
  clock: number;
  margin: number;
  errors: number;
}

export interface Look {
  name: string;
  color: string;
  ink?: string | null;
  mark?: [number, number][][] | null;
}

export interface Swarm {
  /** Counts the swarms of a connection. */
  number: number;
  circuit: string;
  swarm: string | null;
  inputs: Port[];
  outputs: Port[];
  robots: Robot[];
  shown: Source[];
  looks: Look[];
  schematic: string;
  timing: string;
  /** Cycles after which every change has settled. */
  hold: number | null;
  /** Cycles at the start in which the robots take their shape. */
  start: number;
  frames: number;
}

export interface VerdictPort {
  name: string;
  width: number;
}
export interface VerdictValue {
  bits: string;
  text: string;
}

export interface VerdictRow {
  row: number;
  line: number;
  inputs: VerdictValue[];
  expected: (VerdictValue | null)[];
  observed: VerdictValue[];
  passed: boolean;
  cycles: number;
}

export interface Verdict {
  circuit: string;
  title: string;
  swarm: string | null;
  level: Level;
  passed: boolean;
  line: number;
  inputs: VerdictPort[];
  outputs: VerdictPort[];
  rows: VerdictRow[];
}

export type Level = "logic" | "physics";

export interface Card {
  name: string;
  function: string | null;
  about: [string, string][] | string;
  body: string[];
  voxels: Voxel[];
  points: number;
  clock: number;
  margin: number;
  errors: number;
  width: number;
  height: number;
  shipped: boolean;
}

export interface Paint {
  code: string | number;
  name: string;
  about: string;
  look: number;
}
export interface Robots {
  robots: Card[];
  looks: Look[];
  palette: Paint[];
}

export interface EncodedGait {
  frames: number;
  cycles: number;
  poses: string;
}
export interface Character {
  clock: number;
  switches?: number;
  margin: number;
  errors: number;
  glitches: number;
  topples: boolean;
}

export interface Probe {
  gaits: EncodedGait[];
  letters: string;
  function: string | null;
  displacement: number[];
  /** Null if it is no gate, or was not asked for. */
  character: Character | null;
  voxels: Voxel[];
  looks: Look[];
}

export interface Niche {
  place: number[];
  fitness: number[];
  body: string[];
  letters: string;
  function: string | null;
}
/** A name and a number of bins. */
export type Axis = [string, number];

export interface ArchiveEvent {
  event: "archive";
  id: number;
  generation: number;
  axes: Axis[];
  niches: Niche[];
  evaluations: number;
}

export interface ChangedEvent {
  event: "changed";
  path: string;
  stamp: string | null;
}
export interface StoppedEvent {
  event: "stopped";
  reason: string;
}
export type LiveEvent = ArchiveEvent | ChangedEvent | StoppedEvent;

export type Picture = "page" | "gif" | "png" | "svg" | "vcd" | "csv";

/** The fields and the result of each request. */
export interface Verbs {
  hello: [object, Hello];
  files: [object, FileEntry[]];
  read: [{ path: string } | { example: string }, FileText];
  save: [{ path: string; text: string; stamp: string | null }, { stamp: string }];
  program: [{ path: string; text: string }, Checked];
  compile: [{ path: string; circuit: string; swarm: string | null }, { swarm: Swarm }];
  test: [{ path: string; test: number; level: Level }, { results: Verdict[] }];
  replay: [{ path: string; test: number; swarm: string | null; row: number }, { swarm: Swarm }];
  inputs: [{ bits: string }, object];
  clock: [{ bit: number; half: number | null }, object];
  run: [{ speed: number | null }, object];
  pause: [object, object];
  step: [{ cycles: number }, object];
  reset: [object, object];
  seek: [{ cycle: number }, object];
  view: [{ robots: number[] }, object];
  robots: [{ path: string | null }, Robots];
  probe: [{ body: string[]; cycles: number; character: boolean }, Probe];
  keep: [{ path: string | null; name: string; body: string[]; replace: boolean }, { path: string; use: string }];
  evolve: [
    { body: string[] | null; box: [number, number]; generations: number; seed: number },
    { generations: number; evaluations: number },
  ];
  take: [{ what: Picture; cycles: number }, { url: string; name: string }];
}

export type Verb = keyof Verbs;

/** An error that the server answered with. */
export class RequestError extends Error {
  constructor(
    message: string,
    readonly code: string | null,
    readonly help: string | null,
    readonly diagnostics: Diagnostic[],
  ) {
    super(message);
  }
}
