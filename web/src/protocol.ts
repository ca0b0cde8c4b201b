// Generated from the messages of crates/play: NBC_UPDATE_PROTOCOL=1 cargo test -p nbc-play protocol
// docs/play-protocol.md describes them.

/** The niches of an archive that have changed in a generation. */
export type ArchiveChange = {
  id: number,
  generation: number,
  axes: Array<AxisEntry>,
  niches: Array<NicheEntry>,
  evaluations: number,
};

/** The name of an axis and its number of bins. */
export type AxisEntry = [string, number];

export type BitSource = { "input": number }
  | { "robot": number }
  | { "constant": boolean };

/** The character of a body over a few switches. */
export type CharacterSketch = {
  clock: number,
  margin: number,
  errors: number,
  switches: number,
  glitches: number,
  topples: boolean,
};

/** A test by its number in the program, or the text of one that is not in it, such as one that refutes a property. */
export type ChosenTest = number | string;

export type CircuitEntry = {
  name: string,
  /** What `compile` takes, such as `adder[8]`. */
  circuit: string,
  swarms: Array<string>,
  line: number,
};

export type ClaimAnswer = {
  properties: Array<PropertyAnswer>,
};

export type ClaimEntry = {
  index: number,
  circuit: string,
  title: string,
  line: number,
  properties: Array<PropertyEntry>,
};

export type ClassCourse = {
  lessons: Array<ClassLesson>,
};

export type ClassLesson = {
  name: string,
  title: string,
  /** The tasks of its steps. */
  steps: Array<string>,
};

export type ClassMember = {
  name: string,
  /** Where the learner is; none outside of lessons. */
  place: ClassPlace | null,
  /** The number of finished lessons. */
  finished: number,
  /** Seconds since the place has changed. */
  seconds: number,
};

export type ClassName = {
  /** With it, the page can join by this name again. */
  key: string,
};

export type ClassPlace = {
  /** The name of the lesson. */
  lesson: string,
  /** The steps of it that are done. */
  done: number,
  /** The size of their smallest circuit in it. */
  size: number | null,
};

export type ClassRoll = {
  members: Array<ClassMember>,
  most: number,
};

export type EncodedGait = {
  /** Poses in a cycle. */
  frames: number,
  cycles: number,
  /** Base64 of numbers as in a frame. */
  poses: string,
};

export type EvolutionEnd = {
  generations: number,
  evaluations: number,
};

export type EvolveRequest = {
  /** The body to start from, if it is not a random one. */
  body: Array<string> | null,
  /** Columns and rows. */
  box: [number, number],
  generations: number,
  seed: number,
};

export type ExampleEntry = {
  name: string,
  about: string,
};

/** A file that was read or saved and has another stamp, or none because it is gone. */
export type FileChange = {
  path: string,
  stamp: string | null,
};

export type FileEntry = {
  path: string,
  size: number,
};

export type FileStamp = {
  stamp: string | null,
};

export type FileText = {
  path: string,
  text: string,
  /** A text that changes with the file; none for an example. */
  stamp: string | null,
};

export type Finding = {
  code: string,
  severity: "error" | "warning",
  message: string,
  help: string | null,
  /** The main one first. */
  labels: Array<FindingLabel>,
  /** Notes at other places. */
  related: Array<FindingLabel>,
};

export type FindingLabel = {
  file: string,
  start: TextPlace,
  end: TextPlace,
  text: string,
};

export type Greeting = {
  version: string,
  folder: string,
  /** The `file:` URI of the folder, for the language server. */
  root: string,
  /** The file to open first. */
  file: string | null,
  files: Array<FileEntry>,
  examples: Array<ExampleEntry>,
  limits: PlayLimits,
  /** Whether pages with the whole program in them can be made. */
  live_pages: boolean,
  /** The address of a public page, for links to it. */
  public_page: string | null,
  class: boolean,
  cycle_seconds: number,
};

export type KeepRequest = {
  /** The program that is to use it. Its robots are beside it. */
  path: string | null,
  name: string,
  body: Array<string>,
  replace?: boolean,
};

export type KeptRobot = {
  path: string,
  use: string,
};

export type LessonCheck = { "is": "shows", values: { [key in string]: number }, }
  | { "is": "keeps", values: { [key in string]: number }, }
  | { "is": "hides", patterns: Array<{ [key in string]: number }>, }
  | { "is": "has-shown", patterns: Array<{ [key in string]: number }>, }
  | { "is": "designs", gate: string, except: boolean, }
  | { "is": "counts", what: LessonCount, than: LessonComparison, number: number, }
  | { "is": "robots-only", gates: Array<string>, }
  | { "is": "without", words: Array<string>, }
  | { "is": "circuit", name: string, }
  | { "is": "tests-pass" }
  | { "is": "tests-fail" }
  | { "is": "passes", test: string, }
  | { "is": "claims-proved" }
  | { "is": "claims-refuted" }
  | { "is": "tests-kept" }
  | { "is": "program-changed" }
  | { "is": "outputs-lit" }
  | { "is": "evolving" }
  | { "is": "niche-chosen" };

export type LessonComparison = "<=" | ">=" | "=";

export type LessonCount = "robots" | "cycles" | "niches" | "threads";

export type LessonEntry = {
  /** The name of its file without the number and the ending. */
  name: string,
  title: string,
  /** The chapter that begins with it. */
  chapter: string | null,
  /** Its paragraphs; code is between backticks. */
  text: Array<string>,
  /** The program that it begins with. */
  program: string | null,
  /** The same as checks look at it. */
  written: WrittenProgram | null,
  tab: LessonTab,
  hints: Array<string>,
  /** The size of the best known circuit, where the learner makes one. */
  best: LessonGoal | null,
  steps: Array<LessonStep>,
};

export type LessonGoal = {
  number: number,
  of: LessonMeasure,
};

export type LessonList = {
  lessons: Array<LessonEntry>,
  /** What is wrong with the files of an author; such a file gives no lesson. */
  findings: Array<Finding>,
};

/** How a circuit is measured: by its robots, or by the gates of its source. */
export type LessonMeasure = "robots" | "gates";

export type LessonStep = {
  task: string,
  /** The step is done when all of these hold at once. */
  checks: Array<LessonCheck>,
  /** Hints for this step alone. */
  hints: Array<string>,
};

export type LessonTab = "swarm" | "tests" | "robots";

export type ListingRow = {
  /** The digits of the output for which it is, `-` for any; the first row that fits counts. */
  bits: string,
  /** These digits, and what the table has for them, as in the source. */
  at: string,
  text: string,
  line: number,
};

export type NicheEntry = {
  /** The bin on each axis. */
  place: Array<number>,
  fitness: [number, number],
  body: Array<string>,
  letters: string,
  function: string,
};

export type Nothing = Record<symbol, never>;

export type PaletteEntry = {
  /** Its character in the rows of bodies. */
  code: string,
  name: string,
  about: string,
  /** Its index in the looks. */
  look: number,
};

/** Events sent without a request. */
export type PlayEvent = { "event": "archive" } & ArchiveChange
  | { "event": "changed" } & FileChange
  | { "event": "stopped", reason: string, };

export type PlayLimits = {
  robots: number,
  /** Cycles that can be gone back. */
  cycles: number,
  /** Bytes of a message. */
  message: number,
};

export type PortEntry = {
  name: string,
  width: number,
  /** The members of its enumeration, each with its name and its digits. */
  members?: Array<[string, string]>,
};

export type ProbeReport = {
  /** Under each pattern: 00, 01, 10 and 11, or 000 to 111. */
  gaits: Array<EncodedGait>,
  letters: string,
  function: string,
  displacement: Array<number>,
  character: CharacterSketch | null,
  points: number,
  voxels: Array<[number, number, number, number, number]>,
  looks: Array<VoxelLook>,
};

export type ProgramReport = {
  errors: number,
  diagnostics: Array<Finding>,
  circuits: Array<CircuitEntry>,
  tests: Array<TestEntry>,
  claims: Array<ClaimEntry>,
  written: WrittenProgram,
};

export type PropertyAnswer = {
  verdict: "proved" | "refuted" | "undecided",
  /** What the verdict is based on, in words. */
  how: string,
  /** The test that refutes it, as text. */
  test: string | null,
};

export type PropertyEntry = {
  property: string,
  line: number,
};

export type Refusal = {
  message: string,
  help: string | null,
  /** A word for what a page reacts to. */
  code: string | null,
  /** The path that could be saved at instead. */
  instead: string | null,
  diagnostics: Array<Finding>,
};

export type Request = { id: number, } & ({ "do": "hello" }
  | { "do": "lessons" }
  | { "do": "files" }
  | { "do": "read", path?: string, example?: string, }
  | { "do": "save", path: string, text: string, stamp: string | null, }
  | { "do": "program", path: string, text: string, }
  | { "do": "compile", path: string, circuit: string, swarm: string | null, }
  | { "do": "test", path: string, test: ChosenTest, level: TestLevel, }
  | { "do": "prove", path: string, claim: number, }
  | { "do": "replay", path: string, test: ChosenTest, swarm: string | null, world?: string, row: number, }
  | { "do": "inputs", bits: string, }
  | { "do": "clock", bit: number, half: number | null, }
  | { "do": "run", speed: number | null, }
  | { "do": "pause" }
  | { "do": "step", cycles: number, }
  | { "do": "reset" }
  | { "do": "seek", cycle: number, }
  | { "do": "view", robots: Array<number>, }
  | { "do": "robots", path: string | null, }
  | { "do": "probe", body: Array<string>, cycles: number, character?: boolean, }
  | { "do": "keep" } & KeepRequest
  | { "do": "evolve" } & EvolveRequest
  | { "do": "take", what: TakeKind, cycles: number, }
  | { "do": "export", path: string, circuit: string, swarm: string | null, /** Whether the page gets the whole program, or else a recording. */
live: boolean, }
  | { "do": "join", name: string, key?: string, }
  | { "do": "progress", place: ClassPlace | null, finished: number, }
  | { "do": "leave" }
  | { "do": "cancel", of: number, });

export type RobotCard = {
  name: string,
  function: string,
  letters: string,
  about: string,
  /** The rows from the top, a material's code a character. */
  body: Array<string>,
  width: number,
  height: number,
  /** The numbers of the corner points around each voxel, and its index in the looks. */
  voxels: Array<[number, number, number, number, number]>,
  points: number,
  clock: number,
  margin: number,
  errors: number,
  shipped: boolean,
  /** Whether it is of the materials that can be painted, so that it can be probed. */
  painted: boolean,
};

export type RobotCards = {
  robots: Array<RobotCard>,
  looks: Array<VoxelLook>,
  palette: Array<PaletteEntry>,
};

export type RowResult = {
  /** Its number, from 1; both halves of a pulse have the same. */
  row: number,
  line: number,
  /** The thread of a wave machine, from 0. */
  thread: number | null,
  inputs: Array<RowValue>,
  expected: Array<RowValue>,
  observed: Array<RowValue>,
  passed: boolean,
  /** Cycles for which the row was held; none at the level of logic. */
  cycles: number | null,
};

export type RowValue = {
  /** The digits `0`, `1` and `-`. */
  bits: string,
  /** As the user writes it. */
  text: string,
};

export type ServerMessage = { id: number, } & ({ "to": "hello", "ok": Greeting }
  | { "to": "lessons", "ok": LessonList }
  | { "to": "files", "ok": Array<FileEntry> }
  | { "to": "read", "ok": FileText }
  | { "to": "save", "ok": FileStamp }
  | { "to": "program", "ok": ProgramReport }
  | { "to": "compile", "ok": SwarmAnswer }
  | { "to": "replay", "ok": SwarmAnswer }
  | { "to": "test", "ok": TestAnswer }
  | { "to": "prove", "ok": ClaimAnswer }
  | { "to": "robots", "ok": RobotCards }
  | { "to": "probe", "ok": ProbeReport }
  | { "to": "keep", "ok": KeptRobot }
  | { "to": "evolve", "ok": EvolutionEnd }
  | { "to": "take", "ok": TakenFile }
  | { "to": "export", "ok": TakenFile }
  | { "to": "join", "ok": ClassName })
  | { id: number, ok: Nothing, }
  | { id: number, error: Refusal, }
  | { id: number, progress: [number, number], } | PlayEvent;

/** An input that opens and closes latches. */
export type ShownClock = {
  /** The bit of the inputs. */
  bit: number,
  /** Cycles that are enough between two changes of it, for the registers and for the outputs. */
  half: number,
};

/** What is on the other side of a circuit's ports while a test runs. */
export type ShownEnvironment = {
  name: string,
  /** The text that it writes, each piece with the cycles before it; none if it never writes any. */
  screen: Array<[number, string]> | null,
  memories: Array<ShownMemory>,
};

/** A table over an output, such as the instructions of a machine or the transitions of its states. */
export type ShownListing = {
  port: string,
  rows: Array<ListingRow>,
};

/** A memory of an environment. Words are in hexadecimal. */
export type ShownMemory = {
  name: string,
  /** Bits of a word. */
  width: number,
  /** The number of words. */
  size: number,
  /** The words that it begins with, without the zeros at the end. */
  words: Array<string>,
  /** For each of its reads the addresses, each with the cycles before it. */
  reads: Array<Array<[number, number]>>,
  /** The written words, each with the cycles before it and its address. */
  writes: Array<[number, number, string]>,
};

export type ShownRegister = {
  /** The name of its net, after those of the calls that it is in where another has the same. */
  name: string,
  /** The robots that have its bits, the most significant first. */
  robots: Array<number>,
};

export type ShownSchematic = {
  /** The sheets, each after the one around it; the first shows the whole. */
  sheets: Array<ShownSheet>,
  bodies: Array<string>,
  /** For each robot, the sheet that shows it. */
  homes: Array<number>,
};

export type ShownScript = {
  title: string,
  /** The cycles whose inputs it gives. */
  cycles: number,
  environment: ShownEnvironment | null,
};

export type ShownSheet = {
  name: string,
  about: string,
  outer: number | null,
  svg: string,
};

export type ShownSwarm = {
  /** Counts the swarms of a connection; frames have its lowest byte. */
  number: number,
  circuit: string,
  swarm: string | null,
  inputs: Array<PortEntry>,
  outputs: Array<PortEntry>,
  /** The source of each bit of the outputs. */
  shown: Array<BitSource>,
  robots: Array<SwarmRobot>,
  /** The gates of the circuit as it is written. */
  gates: number,
  registers: Array<ShownRegister>,
  listing: ShownListing | null,
  looks: Array<VoxelLook>,
  schematic: ShownSchematic,
  timing: string,
  /** Cycles after which every change has settled. */
  hold: number,
  clocks: Array<ShownClock>,
  /** Cycles at the start in which the robots take their shape. */
  start: number,
  /** The ground's columns, which repeat: the rows from and up to which each is voxels; none if it is flat. */
  ground: Array<Array<number>>,
  /** Poses in a cycle. */
  frames: number,
  waves: ShownWaves | null,
  script: ShownScript | null,
};

/** A wave machine; docs/play-protocol.md says whose wave a robot carries in a cycle. */
export type ShownWaves = {
  /** Cycles of a step. */
  step: number,
  /** Cycles of a beat. */
  beat: number,
  /** Machines that run at once on the same robots. */
  threads: number,
  /** For each robot, the beat of a step in which it reads its stimuli. */
  phases: Array<number>,
  /** The cycle in which the first step of the first thread begins, from 0. */
  begins: number,
  /** The bit of the inputs that is the clock, which no robot senses. */
  clock: number | null,
  registers: Array<WaveRegister>,
};

export type SwarmAnswer = {
  swarm: ShownSwarm,
};

export type SwarmRobot = {
  /** The name by which files and the schematic know its net. */
  net: string,
  /** The name in the source, or for a net without one what drives it, such as `nand(d, e)`. */
  label: string,
  /** Whether the source has a name for it. */
  named: boolean,
  function: string,
  robot: string,
  /** Words with their texts. */
  about: Array<[string, string]>,
  senses: Array<BitSource>,
  /** The rows from the top. */
  body: Array<string>,
  /** Columns and rows. */
  size: [number, number],
  /** The numbers of the corner points around each voxel, and its index in the looks. */
  voxels: Array<[number, number, number, number, number]>,
  points: number,
  clock: number,
  margin: number,
  errors: number,
};

export type TakeKind = "page" | "gif" | "png" | "svg" | "vcd" | "csv";

export type TakenFile = {
  /** Relative to the page. It works once. */
  url: string,
  name: string,
};

/** A result for each swarm of its circuit in each world of the test. */
export type TestAnswer = {
  results: Array<TestResult>,
};

export type TestEntry = {
  index: number,
  circuit: string,
  title: string,
  line: number,
  /** Whether it is decided for ever, at the level of logic alone. */
  ever: boolean,
  inputs: Array<PortEntry>,
  outputs: Array<PortEntry>,
  /** What it gives to its circuit, in words: `all inputs`, `for ever`, or the number of rows. */
  extent: string,
  /** The first rows. None if they are found only when the test runs. */
  rows: Array<TestRowEntry>,
};

export type TestLevel = "logic" | "physics";

export type TestResult = {
  circuit: string,
  title: string,
  swarm: string | null,
  /** The world of the swarm; none at the level of logic. */
  world: string | null,
  fault: string | null,
  level: TestLevel,
  passed: boolean,
  line: number,
  inputs: Array<PortEntry>,
  outputs: Array<PortEntry>,
  rows: Array<RowResult>,
  printed: string | null,
  /** How a test for ever was decided, in words. */
  proof: string | null,
};

export type TestRowEntry = {
  row: number,
  line: number,
  inputs: Array<string>,
  outputs: Array<string>,
};

/** A place in a text: its byte from 0, its line and column from 1. */
export type TextPlace = {
  byte: number,
  line: number,
  column: number,
};

export type VoxelLook = {
  name: string,
  color: string,
  ink: string | null,
  /** Polygons within the unit square. */
  mark: Array<Array<[number, number]>> | null,
};

/** Where and when a bit of such a register is seen. */
export type WaveBit = {
  source: BitSource,
  /** The cycles from the beginning of the step after to the one at whose end the source has the bit. */
  after: number,
  /** The values after no step, after one, and so on, before the source has any. */
  starts: Array<boolean>,
};

export type WaveRegister = {
  name: string,
  /** The most significant first. */
  bits: Array<WaveBit>,
};

export type WrittenProgram = {
  /** Its tokens, with a space between two. */
  text: string,
  /** The words and signs of its circuits, each once, and `calls` if they call circuits of other files. */
  words: Array<string>,
  /** The lines of its tests and claims. */
  kept: Array<string>,
};
