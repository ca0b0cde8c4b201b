// Generated: NBC_UPDATE_PROTOCOL=1 cargo test -p nbc-play protocol
// docs/play-protocol.md describes the messages; the other types are of results.

export type ArchiveAxis = {
  bins: number,
  name: string,
};

/** The niches of an archive that have changed in a generation. */
export type ArchiveChange = {
  axes: Array<ArchiveAxis>,
  evaluations: number,
  generation: number,
  id: number,
  niches: Array<EliteData>,
};

/** The directions under each pattern of two or three stimuli, counted as binary numbers with stimulus 1 first, written as letters: `RRRL` for the patterns 00, 01, 10, 11 (paper, section 3), eight for three stimuli. */
export type Behavior = string;

/** The character of a robot as a gate, measured over switches of its inputs (docs/physics.md 14). */
export type Character = {
  /** Cycles for which an input pattern must be held so that the output is correct at the end of every hold. */
  clock: number,
  /** The share of `switches` with a wrong output at the end of a hold of `clock` cycles. */
  error_rate: number,
  /** The share of wrong cycles in holds whose output should not change. */
  glitch_rate: number,
  /** The smallest displacement in the correct direction at the end of a hold, in voxels per cycle; negative if an output was wrong. */
  margin: number,
  radius?: SafeRadius,
  /** Settle times, one entry for each of the transitions between different patterns: 12 of two stimuli, 56 of three. */
  settle: Array<Transition>,
  /** The number of random switches in which wrong outputs were counted. */
  switches: number,
  /** Whether the body ever fell over. */
  topples: boolean,
};

/** A test by its number in the program, or the text of one that is not in it, such as one that refutes a property. */
export type ChosenTest = number | string;

export type CircuitEntry = {
  /** What `compile` takes, such as `adder[8]`. */
  circuit: string,
  line: number,
  name: string,
  swarms: Array<string>,
};

/** A declared claim. The source is needed for messages only. */
export type Claim = {
  /** A circuit with values for its parameters. */
  circuit: string,
  file: string,
  inputs: Array<Column>,
  line: number,
  outputs: Array<Column>,
  /** As data, those that are to be proved. */
  properties: Array<Property>,
  title: string,
};

export type ClassCourse = {
  lessons: Array<ClassLesson>,
};

export type ClassLesson = {
  name: string,
  /** The tasks of its steps. */
  steps: Array<string>,
  title: string,
};

export type ClassMember = {
  /** The number of finished lessons. */
  finished: number,
  name: string,
  /** Where the learner is; none outside of lessons. */
  place: ClassPlace | null,
  /** Seconds since the place has changed. */
  seconds: number,
};

export type ClassName = {
  /** With it, the page can join by this name again. */
  key: string,
};

export type ClassPlace = {
  /** The steps of it that are done. */
  done: number,
  /** The name of the lesson. */
  lesson: string,
  /** The size of their smallest circuit in it. */
  size: number | null,
};

export type ClassRoll = {
  members: Array<ClassMember>,
  most: number,
};

/** A port with its width: a column of a test, a waveform or a table. */
export type Column = {
  /** The members of its enumeration with their digits: `[["fetch", "0"], ["execute", "1"]]`. */
  members?: Array<[string, string]>,
  name: string,
  /** The width in bits, at least 1. */
  width: number,
};

/** A claim, or the properties of a model, with a verdict on each property except assumptions. */
export type DecidedClaim = {
  circuit?: string,
  file: string,
  line?: number,
  properties: Array<DecidedProperty>,
  title?: string,
  /** Calls of the solver plus learned clauses. */
  work: number,
};

export type DecidedProperty = {
  /** Why the proof is vacuous. */
  empty?: string,
  /** What the verdict is based on, in words. */
  how: string,
  /** Clauses that hold in every step. */
  invariant?: Array<string>,
  /** `None` for a model. */
  line?: number,
  /** `induction` or `invariant`. */
  method?: string,
  /** Whether robots do the same as the test. */
  physics?: boolean,
  /** As written, or the name of a bad state of a model. */
  property: string,
  /** Steps of the induction or of the run, or the first steps in which it is known to hold. */
  steps?: number,
  /** A test that refutes it, in the language. */
  test?: string,
  /** `proved`, `refuted` or `undecided`. */
  verdict: "proved" | "refuted" | "undecided",
  /** Numbers of the other properties that this proof needs, from 0. */
  with?: Array<number>,
  /** In AIGER's format. */
  witness?: string,
};

/** Displacements in voxels, one for each pattern of two or three stimuli, counted as binary numbers with stimulus 1 first. */
export type Displacements = Array<number>;

export type EliteData = {
  /** Voxels that swell with time. */
  actuators: number,
  behavior: Behavior,
  /** Rows of material codes, top row first; 0 is empty. */
  body: Array<string>,
  displacement: Displacements,
  /** Bodies tried up to and with it. */
  evaluations: number,
  /** The two fitnesses of the run's objective. */
  fitness: [number, number],
  /** The gate, such as `nand`. */
  function: string,
  /** The generation in which it was born. */
  generation: number,
  height: number,
  /** The materials of the codes from 1 on, if they are not the paper's. */
  materials?: Palette,
  /** The bin on each axis, from 0. */
  niche: Array<number>,
  seed: number,
  /** Voxels that respond to a stimulus. */
  sensors: number,
  voxels: number,
  width: number,
};

export type EncodedGait = {
  cycles: number,
  /** Poses in a cycle. */
  frames: number,
  /** Base64 of numbers as in a frame. */
  poses: string,
};

export type EvolutionData = {
  axes: Array<ArchiveAxis>,
  behaviors: Array<PageBehavior>,
  /** Cycles under each of them. */
  cycles: number,
  elites: Array<PageElite>,
  /** What is shown of each image: rows from the top, 1 is black. */
  images: Array<Array<Array<number>>>,
  looks: Array<VoxelLook>,
  /** Frames in a cycle. */
  pace: number,
  /** The patterns, or as many as there are images. */
  patterns: Array<string>,
};

export type EvolutionEnd = {
  evaluations: number,
  generations: number,
};

export type EvolveRequest = {
  /** The body to start from, if it is not a random one. */
  body?: Array<string> | null,
  /** Columns and rows. */
  box: [number, number],
  generations: number,
  seed: number,
};

export type ExampleEntry = {
  about: string,
  name: string,
};

/** The reason why a simulation failed. */
export type FaultKind = "unstable" | "non_finite" | "stopped";

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
  /** A text that changes with the file; none for an example. */
  stamp: string | null,
  text: string,
};

/** A diagnostic for programs and pages, with file names, lines and columns. */
export type Finding = {
  /** `nbc explain CODE` tells more. */
  code: string,
  /** Edits that do what the help says, if they certainly remove the fault. */
  fix: FoundFix | null,
  /** What to do about it. */
  help: string | null,
  /** The places, the main one first. */
  labels: Array<PlacedText>,
  message: string,
  /** Notes at other places. */
  related: Array<PlacedText>,
  severity: Severity,
};

export type FoundFix = {
  /** Replacements that do not overlap, in order of place. */
  edits: Array<PlacedText>,
  /** What the edits do, for a menu. */
  title: string,
};

export type Greeting = {
  class: boolean,
  cycle_seconds: number,
  examples: Array<ExampleEntry>,
  /** The file to open first. */
  file: string | null,
  files: Array<FileEntry>,
  folder: string,
  limits: PlayLimits,
  /** Whether pages with the whole program in them can be made. */
  live_pages: boolean,
  /** The address of a public page, for links to it. */
  public_page: string | null,
  /** The `file:` URI of the folder, for the language server. */
  root: string,
  version: string,
};

/** The numbers of rows and of columns of an image. As data it is a list of both. */
export type ImageSize = [number, number];

export type KeepRequest = {
  body: Array<string>,
  name: string,
  /** The program that is to use it. Its robots are beside it. */
  path?: string | null,
  replace?: boolean | null,
};

export type KeptRobot = {
  path: string,
  use: string,
};

export type LessonCheck = { is: "shows", values: { [key in string]: number } }
  | { is: "keeps", values: { [key in string]: number } }
  | { is: "hides", patterns: Array<{ [key in string]: number }> }
  | { is: "has-shown", patterns: Array<{ [key in string]: number }> }
  | { except: boolean, gate: string, is: "designs" }
  | { is: "counts", number: number, than: LessonComparison, what: LessonCount }
  | { gates: Array<string>, is: "robots-only" }
  | { is: "without", words: Array<string> }
  | { is: "circuit", name: string }
  | { is: "tests-pass" }
  | { is: "tests-fail" }
  | { is: "passes", test: string }
  | { is: "claims-proved" }
  | { is: "claims-refuted" }
  | { is: "tests-kept" }
  | { is: "program-changed" }
  | { is: "outputs-lit" }
  | { is: "evolving" }
  | { is: "niche-chosen" };

export type LessonComparison = "<=" | ">=" | "=";

export type LessonCount = "robots" | "cycles" | "niches" | "threads";

export type LessonEntry = {
  /** The size of the best known circuit, where the learner makes one. */
  best: LessonGoal | null,
  /** The chapter that begins with it. */
  chapter: string | null,
  hints: Array<string>,
  /** The name of its file without the number and the ending. */
  name: string,
  /** The program that it begins with. */
  program: string | null,
  steps: Array<LessonStep>,
  tab: LessonTab,
  /** Its paragraphs; code is between backticks. */
  text: Array<string>,
  title: string,
  /** The same as checks look at it. */
  written: WrittenProgram | null,
};

export type LessonGoal = {
  number: number,
  of: LessonMeasure,
};

export type LessonList = {
  /** What is wrong with the files of an author; such a file gives no lesson. */
  findings: Array<Finding>,
  lessons: Array<LessonEntry>,
};

/** How a circuit is measured: by its robots, or by the gates of its source. */
export type LessonMeasure = "robots" | "gates";

export type LessonStep = {
  /** The step is done when all of these hold at once. */
  checks: Array<LessonCheck>,
  /** Hints for this step alone. */
  hints: Array<string>,
  task: string,
};

export type LessonTab = "swarm" | "tests" | "robots";

export type Level = "physics" | "logic";

export type ListingRow = {
  /** These digits, and what the table has for them, as in the source. */
  at: string,
  /** The digits of the output for which it is, `-` for any; the first row that fits counts. */
  bits: string,
  line: number,
  text: string,
};

/** A declared material: a name and a response. */
export type Material = {
  /** Width of a sensor without its stimulus. */
  absent?: number,
  /** Rows and columns of the image that a sensor senses. */
  image?: ImageSize,
  kind: Word,
  name: string,
  /** Of an actuator, in env steps. */
  period?: number,
  /** Of an actuator, in degrees. */
  phase?: number,
  /** Width of a sensor with its stimulus. */
  present?: number,
  /** Least and greatest width of an actuator. */
  range?: [number, number],
  /** Of a sensor, counted from 1. */
  stimulus?: number,
};

export type Nothing = Record<string, never>;

export type PageBehavior = {
  function: string,
  word: string,
};

/** A robot of a circuit. */
export type PageCell = {
  /** Words with their texts. */
  about: Array<[string, string]>,
  function: string,
  net: string,
  /** The nets that it senses. */
  reads: Array<string>,
};

/** The best of a niche; there may have been no room for its gait. */
export type PageElite = {
  about: Array<[string, string]>,
  /** Voxels that swell with time. */
  actuators: number,
  behavior: Behavior,
  /** Rows of material codes, top row first; 0 is empty. */
  body: Array<string>,
  color: string,
  displacement: Displacements,
  /** Bodies tried up to and with it. */
  evaluations: number,
  /** The two fitnesses of the run's objective. */
  fitness: [number, number],
  /** The gate, such as `nand`. */
  function: string,
  gait?: RecordedBody,
  /** The generation in which it was born. */
  generation: number,
  height: number,
  /** The materials of the codes from 1 on, if they are not the paper's. */
  materials?: Palette,
  /** The bin on each axis, from 0. */
  niche: Array<number>,
  seed: number,
  /** Voxels that respond to a stimulus. */
  sensors: number,
  voxels: number,
  width: number,
};

/** The materials of a body: code 0 is empty, code `k` is the `k`-th material.  Palettes are equal when their materials have the same names and, to the bit, the same numbers. */
export type Palette = Array<Material>;

export type PaletteEntry = {
  about: string,
  /** Its character in the rows of bodies. */
  code: string,
  /** Its index in the looks. */
  look: number,
  name: string,
};

export type PlacedText = {
  /** One past the last character. */
  end: TextPlace,
  file: string,
  start: TextPlace,
  /** What is said of the place; in an edit, the text to write there. */
  text: string,
};

/** Events sent without a request. */
export type PlayEvent = { event: "archive" } & ArchiveChange
  | { event: "changed" } & FileChange
  | { event: "stopped", reason: string };

export type PlayLimits = {
  /** Cycles that can be gone back. */
  cycles: number,
  /** Bytes of a message. */
  message: number,
  robots: number,
};

export type ProbeReport = {
  /** Over a few switches. */
  character: Character | null,
  displacement: Array<number>,
  function: string,
  /** Under each pattern: 00, 01, 10 and 11, or 000 to 111. */
  gaits: Array<EncodedGait>,
  letters: string,
  looks: Array<VoxelLook>,
  points: number,
  voxels: Array<[number, number, number, number, number]>,
};

export type ProgramReport = {
  circuits: Array<CircuitEntry>,
  claims: Array<Claim>,
  diagnostics: Array<Finding>,
  errors: number,
  tests: Array<TestEntry>,
  written: WrittenProgram,
};

export type Property = {
  line: number,
  property: string,
};

/** A body with its poses. */
export type RecordedBody = {
  /** The number of points. */
  corners: number,
  /** The base64 of hundredths of a voxel: x and y of each point, frame by frame. */
  frames: string,
  voxels: Array<[number, number, number, number, number]>,
};

/** A robot of a circuit. */
export type RecordedCell = {
  /** Words with their texts. */
  about: Array<[string, string]>,
  /** Hexadecimal digits of four cycles each, the first cycle highest. */
  bits: string,
  function: string,
  net: string,
  /** The nets that it senses. */
  reads: Array<string>,
};

/** A body with its poses. */
export type RecordedRobot = {
  /** Its place among the cells. */
  cell: number,
  /** The number of points. */
  corners: number,
  /** The frame in which it became unstable. */
  fault: number | null,
  /** The base64 of hundredths of a voxel: x and y of each point, frame by frame. */
  frames: string,
  /** For each stimulus, a digit a cycle. */
  sensed: Array<string>,
  /** Columns and rows. */
  size: [number, number],
  voxels: Array<[number, number, number, number, number]>,
};

export type RecordedSwarm = {
  cells: Array<RecordedCell>,
  cycles: number,
  inputs: Array<WaveRow>,
  /** The cycles at which inputs change. */
  marks: Array<number>,
  outputs: Array<WaveRow>,
  /** Frames in a cycle. */
  pace: number,
  robots: Array<RecordedRobot>,
  schematic: SchematicPages,
};

export type Refusal = {
  /** A word for what a page reacts to. */
  code: string | null,
  diagnostics: Array<Finding>,
  help: string | null,
  /** The path that could be saved at instead. */
  instead: string | null,
  message: string,
};

export type Request = { id: number } & ({ do: "hello" }
  | { do: "lessons" }
  | { do: "files" }
  | { do: "read", example?: string | null, path?: string | null }
  | { do: "save", path: string, stamp?: string | null, text: string }
  | { do: "program", path: string, text: string }
  | { circuit: string, do: "compile", path: string, swarm?: string | null }
  | { do: "test", level: Level, path: string, test: ChosenTest }
  | { claim: number, do: "prove", path: string }
  | { do: "replay", path: string, row: number, swarm?: string | null, test: ChosenTest, world?: string | null }
  | { bits: string, do: "inputs" }
  | { bit: number, do: "clock", half?: number | null }
  | { do: "settle", rows: Array<string> }
  | { do: "run", speed?: number | null }
  | { do: "pause" }
  | { cycles: number, do: "step" }
  | { do: "reset" }
  | { cycle: number, do: "seek" }
  | { do: "view", robots: Array<number> }
  | { do: "robots", path?: string | null }
  | { body: Array<string>, character?: boolean | null, cycles: number, do: "probe" }
  | { do: "keep" } & KeepRequest
  | { do: "evolve" } & EvolveRequest
  | { cycles: number, do: "take", what: TakeKind }
  | { circuit: string, do: "export", live: boolean, path: string, swarm?: string | null }
  | { do: "join", key?: string | null, name: string }
  | { do: "progress", finished: number, place?: ClassPlace | null }
  | { do: "leave" }
  | { do: "cancel", of: number });

export type RobotCard = {
  about: string,
  behavior: string,
  body: Array<string>,
  /** Columns and rows, such as `5x5`. */
  box: string,
  /** Cycles for which a pattern must be held. */
  clock: number,
  /** The share of random switches with a wrong output. */
  error_rate: number,
  function: string,
  /** The share of wrong cycles in which the output should not change. */
  glitch_rate: number,
  /** The smallest displacement in voxels per cycle. */
  margin: number,
  /** The materials of the codes, if they are not the paper's. */
  materials?: Palette,
  name: string,
  /** Whether it is of the materials that can be painted, so that it can be probed. */
  painted: boolean,
  points: number,
  /** How far worlds may differ before it makes errors, if that was measured. */
  radius?: SafeRadius,
  /** The longest settle time in cycles; none if it was not measured. */
  settle?: number,
  shipped: boolean,
  switches: number,
  /** The numbers of the corner points around each voxel, and its index in the looks. */
  voxels: Array<[number, number, number, number, number]>,
};

export type RobotCards = {
  looks: Array<VoxelLook>,
  palette: Array<PaletteEntry>,
  robots: Array<RobotCard>,
};

/** The robot of a swarm whose simulation failed first. The swarm has no outputs from its cycle on. */
export type RobotFault = {
  /** The cycle, from 0 at the start. */
  cycle: number,
  /** The env step that was abandoned, from 1 at the start. */
  env_step: number,
  kind: FaultKind,
  net: string,
  robot: string,
};

export type RowSource = {
  /** The share of the rows in percent that must pass, if not all must. */
  at_least?: number,
  file: string,
};

export type RowVerdict = {
  /** Cycles for which the row was held; none at the level of logic. */
  cycles: number | null,
  expected: Array<Value>,
  /** The robot that failed in the row or before it, so that the swarm had no outputs at its end. */
  fault?: RobotFault,
  inputs: Array<Value>,
  /** If the row failed: robots that were wrong although their stimuli had been stable for at least their clock. */
  lapses: Array<WrongOutput>,
  /** If the row failed: robots that were wrong in its last cycle and whose stimuli had been stable for less than their clock. */
  late: Array<WrongOutput>,
  line: number,
  /** Cycles for which `hold: auto` would hold it; none at the level of logic. */
  needed: number | null,
  /** The values of the output ports at the end of the row; none where a robot failed. */
  observed: Array<Value>,
  /** Whether every checked output had its expected value and kept it. */
  passed: boolean,
  /** Its number among the rows of the source, from 1; both halves of a pulse have the same. */
  row: number,
  /** For each output port, whether it was steady: over the last two cycles in physics, forever at the level of logic. */
  steady: Array<boolean>,
  /** The thread of a wave machine, from 0; none in other swarms. */
  thread?: number,
  /** How often it was repeated, if that is as often as its `until` permits and it still waited for its value. */
  until?: number,
  /** How it failed, in lines; none if it passed. */
  words?: string,
};

export type RunData = {
  looks: Array<VoxelLook>,
  swarms: Array<RecordedSwarm>,
};

/** How far a world may differ before a robot makes errors. */
export type SafeRadius = {
  /** The share of switches with a wrong output in the worlds of radius 1, if it was counted. */
  error_rate?: number,
  /** The largest factor of the changes up to which no output was wrong. */
  radius: number,
  seed: number,
  /** The largest changes of the worlds at radius 1, such as `friction=10%,gravity=5%`. */
  vary: string,
  /** The number of worlds that were tried at each radius. */
  worlds: number,
};

export type SchematicPages = {
  /** The bodies of the robots, as SVG. A group `body-K` of a sheet is the place of body `K`. */
  bodies: Array<string>,
  /** For each robot, the sheet that shows it. */
  homes: Array<number>,
  sheets: Array<SheetPage>,
};

export type ServerMessage = { id: number } & ({ ok: Greeting, to: "hello" }
  | { ok: LessonList, to: "lessons" }
  | { ok: Array<FileEntry>, to: "files" }
  | { ok: FileText, to: "read" }
  | { ok: FileStamp, to: "save" }
  | { ok: ProgramReport, to: "program" }
  | { ok: SwarmAnswer, to: "compile" }
  | { ok: SwarmAnswer, to: "replay" }
  | { ok: SettledOutputs, to: "settle" }
  | { ok: TestAnswer, to: "test" }
  | { ok: DecidedClaim, to: "prove" }
  | { ok: RobotCards, to: "robots" }
  | { ok: ProbeReport, to: "probe" }
  | { ok: KeptRobot, to: "keep" }
  | { ok: EvolutionEnd, to: "evolve" }
  | { ok: TakenFile, to: "take" }
  | { ok: TakenFile, to: "export" }
  | { ok: ClassName, to: "join" })
  | { id: number, ok: Nothing }
  | { error: Refusal, id: number }
  | { id: number, progress: [number, number] }
  | { found: Array<TestVerdict>, id: number } | PlayEvent;

export type SettledOutputs = {
  /** For each row of inputs; none of a swarm with a state. */
  outputs: Array<string> | null,
};

/** The severity of a diagnostic. */
export type Severity = "error" | "warning";

export type SheetPage = {
  /** More about it, such as `adder, 37 robots`. */
  about: string,
  /** The names of the nets of each group `nets-N`. */
  bundles: Array<Array<string>>,
  name: string,
  outer: number | null,
  /** The drawing: a group `cell-N` is robot `N`, `part-N` the box of sheet `N`, `net-NAME` the wires of a net, and `nets-N` those of several. */
  svg: string,
};

export type SheetsData = {
  cells: Array<PageCell>,
  schematic: SchematicPages,
};

/** An input that opens and closes latches. */
export type ShownClock = {
  /** The bit of the inputs. */
  bit: number,
  /** Cycles that are enough between two changes of it, for the registers and for the outputs. */
  half: number,
};

/** What is on the other side of a circuit's ports while a test runs. */
export type ShownEnvironment = {
  memories: Array<ShownMemory>,
  name: string,
  /** The text that it writes, each piece with the cycles before it; none if it never writes any. */
  screen: Array<[number, string]> | null,
};

/** A table over an output, such as the instructions of a machine or the transitions of its states. */
export type ShownListing = {
  port: string,
  rows: Array<ListingRow>,
};

/** A memory of an environment. Words are in hexadecimal. */
export type ShownMemory = {
  name: string,
  /** For each of its reads the addresses, each with the cycles before it. */
  reads: Array<Array<[number, number]>>,
  /** The number of words. */
  size: number,
  /** Bits of a word. */
  width: number,
  /** The words that it begins with, without the zeros at the end. */
  words: Array<string>,
  /** The written words, each with the cycles before it and its address. */
  writes: Array<[number, number, string]>,
};

export type ShownRegister = {
  /** The name of its net, after those of the calls that it is in where another has the same. */
  name: string,
  /** The robots that have its bits, the most significant first. */
  robots: Array<number>,
};

export type ShownScript = {
  /** The cycles whose inputs it gives. */
  cycles: number,
  environment: ShownEnvironment | null,
  title: string,
};

export type ShownSwarm = {
  circuit: string,
  clocks: Array<ShownClock>,
  /** Poses in a cycle. */
  frames: number,
  /** The gates of the circuit as it is written. */
  gates: number,
  /** The ground's columns, which repeat: the rows from and up to which each is voxels; none if it is flat. */
  ground: Array<Array<number>>,
  /** Cycles after which every change has settled. */
  hold: number,
  inputs: Array<Column>,
  listing: ShownListing | null,
  looks: Array<VoxelLook>,
  /** Counts the swarms of a connection; frames have its lowest byte. */
  number: number,
  outputs: Array<Column>,
  /** For each robot, the env steps by which its own cycles are ahead at the start and the millionths by which they are faster; none with a common clock. */
  own_clocks: Array<[number, number]>,
  registers: Array<ShownRegister>,
  robots: Array<SwarmRobot>,
  schematic: SchematicPages,
  script: ShownScript | null,
  /** The source of each bit of the outputs. */
  shown: Array<StimulusSource>,
  /** Cycles at the start in which the robots take their shape. */
  start: number,
  swarm: string | null,
  timing: string,
  waves: ShownWaves | null,
};

/** A wave machine; docs/play-protocol.md says whose wave a robot carries in a cycle. */
export type ShownWaves = {
  /** Cycles of a beat. */
  beat: number,
  /** The cycle in which the first step of the first thread begins, from 0. */
  begins: number,
  /** The bit of the inputs that is the clock, which no robot senses. */
  clock: number | null,
  /** For each robot, the beat of a step in which it reads its stimuli. */
  phases: Array<number>,
  registers: Array<WaveRegister>,
  /** Cycles of a step. */
  step: number,
  /** Machines that run at once on the same robots. */
  threads: number,
};

/** The source of a stimulus or of an output port's bit. */
export type StimulusSource = { input: number }
  | { robot: number }
  | { constant: boolean };

export type SwarmAnswer = {
  swarm: ShownSwarm,
};

export type SwarmRobot = {
  /** Words with their texts. */
  about: Array<[string, string]>,
  /** The rows from the top. */
  body: Array<string>,
  clock: number,
  errors: number,
  function: string,
  /** The name in the source, or for a net without one what drives it, such as `nand(d, e)`. */
  label: string,
  margin: number,
  /** Whether the source has a name for it. */
  named: boolean,
  /** The name by which files and the schematic know its net. */
  net: string,
  points: number,
  robot: string,
  senses: Array<StimulusSource>,
  /** Columns and rows. */
  size: [number, number],
  /** The numbers of the corner points around each voxel, and its index in the looks. */
  voxels: Array<[number, number, number, number, number]>,
};

export type TakeKind = "page" | "gif" | "png" | "svg" | "vcd" | "csv";

export type TakenFile = {
  name: string,
  /** Relative to the page. It works once. */
  url: string,
};

/** A result for each swarm of its circuit in each world of the test. */
export type TestAnswer = {
  results: Array<TestVerdict>,
};

export type TestEntry = {
  circuit: string,
  /** Whether it is decided for ever, at the level of logic alone. */
  ever: boolean,
  /** What it gives to its circuit, in words: `all inputs`, `for ever`, or the number of rows. */
  extent: string,
  index: number,
  inputs: Array<Column>,
  line: number,
  outputs: Array<Column>,
  /** The first rows. None if they are found only when the test runs. */
  rows: Array<TestRowEntry>,
  title: string,
};

export type TestRowEntry = {
  inputs: Array<string>,
  line: number,
  outputs: Array<string>,
  row: number,
};

export type TestVerdict = {
  circuit: string,
  /** How a robot failed, in words: `robot nand_5x5 on net q became unstable in cycle 3`. */
  fault?: string,
  file: string,
  inputs: Array<Column>,
  level: Level,
  line: number,
  outputs: Array<Column>,
  /** Whether all rows passed, or as many as the test asks for. */
  passed: boolean,
  /** What the environment of the test wrote as text. */
  printed?: string,
  /** How a test for ever was decided, in words: `proved by induction over 1 step`. */
  proof?: string,
  rows: Array<RowVerdict>,
  /** The file of its rows, if the source does not have them. */
  rows_from?: RowSource,
  /** The declared swarm, if it is one. */
  swarm: string | null,
  title: string,
  /** Robots that make errors or have a thin margin. */
  weak_robots: Array<WeakRobot>,
  /** The world of the swarm; none at the level of logic, which has no worlds. */
  world: string | null,
};

export type TextPlace = {
  /** From 0. */
  byte: number,
  /** From 1, in characters. */
  column: number,
  /** From 1. */
  line: number,
};

/** The settle time of one input transition. */
export type Transition = {
  cycles: number,
  from: string,
  to: string,
};

/** A `Value` as data. */
export type Value = {
  /** The most significant bit first; `-` where nothing is expected or a robot failed. */
  bits: string,
  /** As the user writes it, such as `4'd5`. */
  text: string,
};

export type VoxelLook = {
  color: string,
  ink?: string,
  /** Polygons within the unit square. */
  mark?: Array<Array<[number, number]>>,
  name: string,
};

/** Where and when a bit of such a register is seen. */
export type WaveBit = {
  /** The cycles from the beginning of the step after to the one at whose end the source has the bit. */
  after: number,
  source: StimulusSource,
  /** The values after no step, after one, and so on, before the source has any. */
  starts: Array<boolean>,
};

export type WaveRegister = {
  /** The most significant first. */
  bits: Array<WaveBit>,
  name: string,
};

/** A row of a waveform, whose values apply `shift` cycles later. */
export type WaveRow = {
  /** The name of its color in the style sheet. */
  color: string,
  name: string,
  shift: number,
  values: WaveValues,
};

/** The digits of a bit, or the values of a bus. */
export type WaveValues = string | Array<string>;

/** A robot of a swarm with errors or a thin margin. */
export type WeakRobot = {
  /** Wrong outputs as a share of the switches. */
  error_rate: number,
  /** Its margin in voxels a cycle. */
  margin: number,
  nets: Array<string>,
  robot: string,
};

export type Word = "rigid" | "soft" | "actuator" | "sensor";

export type WrittenProgram = {
  /** The lines of its tests and claims. */
  kept: Array<string>,
  /** Its tokens, with a space between two. */
  text: string,
  /** The words and signs of its circuits, each once, and `calls` if they call circuits of other files. */
  words: Array<string>,
};

/** A robot whose output was not its function of its stimuli. */
export type WrongOutput = {
  /** The cycle, from 0 at the test's start. */
  cycle: number,
  net: string,
  output: boolean,
  robot: string,
  sensed: Array<boolean>,
};
