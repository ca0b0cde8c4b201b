//! Errors and warnings of compiling and running a program that has no errors itself, and their messages.

use crate::report;
use nbc_base::budget::Limit;
use nbc_base::diag::{Code, Diagnostic, Suggestion, counted, suggest};
use nbc_base::model::{Behavior, ImageSize};
use nbc_base::source::Span;
use nbc_circuit::properties::NoSteps;
use nbc_circuit::waves::WaveError;
use nbc_circuit::{EnvironmentFault, MapError};
use nbc_swarm::WeakRobot;

/// Rows that no circuit can be learned from. These errors have no place.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum LearningError {
    /// A file name without the extension of rows.
    Format { file: String },
    /// Rows that belong together, but none.
    NoGroup,
    /// A share that is held out and is no share.
    HoldOut { percent: f64 },
    /// A circuit of too many inputs and outputs.
    TooLarge { inputs: usize, outputs: usize },
    /// So few rows that none are left to learn from.
    NoTraining { rows: usize, percent: f64 },
    /// A circuit whose confusions are no table.
    NoConfusion { circuit: String },
}

impl From<LearningError> for Diagnostic {
    fn from(error: LearningError) -> Self {
        match error {
            LearningError::Format { file } => {
                let message = format!("unrecognized format of the rows in `{file}`; expected .csv or .pla");
                Self::without_place(Code::BadValue, message)
            }
            LearningError::NoGroup => {
                Self::without_place(Code::BadValue, "invalid group of 0 rows; expected at least 1")
            }
            LearningError::HoldOut { percent } => {
                let message =
                    format!("invalid share {percent} % to hold out; expected a number from 0 to less than 100");
                Self::without_place(Code::BadValue, message)
            }
            LearningError::TooLarge { inputs, outputs } => {
                let (inputs, outputs) = (counted(inputs, "input bit"), counted(outputs, "output bit"));
                let most = Limit::LearnedBits.most();
                Self::without_place(
                    Code::TooLarge,
                    format!("a circuit of {inputs} and {outputs} is too large to learn"),
                )
                .with_help(format!("expected at most {most} input bits times output bits"))
            }
            LearningError::NoTraining { rows, percent } => {
                let message = format!("{percent} % of {} leave none to learn from", counted(rows, "row"));
                Self::without_place(Code::BadValue, message).with_help("hold out fewer rows: `--hold-out 0`")
            }
            LearningError::NoConfusion { circuit } => {
                Self::without_place(Code::BadValue, format!("`{circuit}` has no table of confusions"))
                    .with_help("such a table is of one output with at most 16 values")
            }
        }
    }
}

/// Bodies and images that do not fit each other. These errors have no place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum RecognitionError {
    /// A name that the program does not have.
    Unknown { kind: &'static str, name: String, meant: Suggestion },
    /// An evolution with another objective.
    NoImages { evolution: String },
    /// A schedule of another number of sets than the evolution's.
    Sets { schedule: String, found: usize, expected: usize },
    /// A run without bodies so far.
    NoBodies { evolution: String },
    /// Bodies of other materials than the evolution declares.
    OtherMaterials { evolution: String },
}

impl From<RecognitionError> for Diagnostic {
    fn from(error: RecognitionError) -> Self {
        match error {
            RecognitionError::Unknown { kind, name, meant } => {
                Self::without_place(Code::Unknown, format!("no {kind} is called `{name}`"))
                    .with_suggestion(None, &meant)
            }
            RecognitionError::NoImages { evolution } => {
                let message = format!("the bodies of `{evolution}` see no images");
                Self::without_place(Code::BadValue, message).with_help("expected an evolution with `objective: images`")
            }
            RecognitionError::Sets { schedule, found, expected } => {
                let (found, sets) = (counted(found, "set"), counted(expected, "set"));
                let message = format!("the schedule `{schedule}` shows {found} of images, expected {sets}");
                Self::without_place(Code::BadValue, message)
                    .with_help("its sets are those of the evolution's schedule, in the same order")
            }
            RecognitionError::NoBodies { evolution } => {
                Self::without_place(Code::Empty, format!("the run of `{evolution}` has no bodies"))
                    .with_help("go on with it: `nbc evolve FILE --run NAME --resume`")
            }
            RecognitionError::OtherMaterials { evolution } => {
                let message = format!("the bodies have other materials than `{evolution}` declares");
                Self::without_place(Code::Checkpoint, message)
            }
        }
    }
}

/// An invalid choice of a circuit, swarm or library. These errors have no place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum ChoiceError {
    /// A source without circuits of its own.
    NoCircuit,
    /// A circuit without a number for a parameter; `all` is how many parameters it has.
    NoNumber { circuit: String, parameter: String, all: usize },
    /// An undeclared swarm.
    UnknownSwarm { name: String, meant: Suggestion },
    /// A circuit with several swarms, without a choice of one.
    SeveralSwarms { circuit: String, swarms: [String; 2] },
    /// A swarm that is declared for another circuit.
    OtherCircuit { swarm: String, own: String, circuit: String },
    /// A circuit that cannot be made of the library's cells.
    Unmapped(MapError),
    /// Registers of multiplexers with a library that has no steady one.
    NoMultiplexer,
    /// A circuit that cannot be a wave machine.
    NoWaves(WaveError),
}

impl From<ChoiceError> for Diagnostic {
    fn from(error: ChoiceError) -> Self {
        match error {
            ChoiceError::NoCircuit => Self::without_place(Code::Empty, "the file declares no circuit")
                .with_help("choose one that it uses: `--circuit NAME`"),
            ChoiceError::NoNumber { circuit, parameter, all } => {
                let numbers = vec!["4"; all].join(", ");
                let message = format!("the parameter `{parameter}` of `{circuit}` has no number");
                Self::without_place(Code::UnknownWidth, message)
                    .with_help(format!("give one for each parameter, such as `--circuit '{circuit}[{numbers}]'`"))
            }
            ChoiceError::UnknownSwarm { name, meant } => {
                Self::without_place(Code::Unknown, format!("no swarm is called `{name}`")).with_suggestion(None, &meant)
            }
            ChoiceError::SeveralSwarms { circuit, swarms: [first, second] } => {
                Self::without_place(Code::BadValue, format!("several swarms are declared for `{circuit}`"))
                    .with_help(format!("choose one, for example `--swarm {first}` or `--swarm {second}`"))
            }
            ChoiceError::OtherCircuit { swarm, own, circuit } => Self::without_place(
                Code::BadValue,
                format!("the swarm `{swarm}` is declared for `{own}`, not for `{circuit}`"),
            ),
            ChoiceError::Unmapped(error) => {
                let code = match error {
                    MapError::Netlist(_) => Code::CircuitFile,
                    MapError::TooLarge { .. } => Code::TooLarge,
                    MapError::Incomplete { .. } => Code::IncompleteLibrary,
                };
                let fault = Self::without_place(code, error.to_string());
                error.help().into_iter().fold(fault, Self::with_help)
            }
            ChoiceError::NoMultiplexer => {
                let message =
                    "the library has no multiplexer without glitches, of which `registers: mux` makes latches";
                Self::without_place(Code::IncompleteLibrary, message).with_help("write `library: three`")
            }
            ChoiceError::NoWaves(WaveError::Unmapped(error)) => ChoiceError::Unmapped(error).into(),
            ChoiceError::NoWaves(error) => {
                let fault = Self::without_place(Code::NoWaves, error.to_string());
                error.help().into_iter().fold(fault, Self::with_help)
            }
        }
    }
}

/// A name that no function of a robot has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct UnknownFunction {
    pub name: String,
    pub known: Vec<&'static str>,
}

impl From<UnknownFunction> for Diagnostic {
    fn from(UnknownFunction { name, known }: UnknownFunction) -> Self {
        Self::without_place(Code::BadValue, format!("`{name}` is not a function of two inputs"))
            .with_help(format!("the functions are {}", known.join(", ")))
            .with_near(&Suggestion::near(&name, known))
    }
}

/// A circuit that cannot be hardened.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum HardenError {
    /// It has no tests.
    NoTest { circuit: String },
}

impl From<HardenError> for Diagnostic {
    fn from(HardenError::NoTest { circuit }: HardenError) -> Self {
        Self::without_place(Code::Empty, format!("the file has no test of `{circuit}`"))
            .with_help("hardening runs the tests of the circuit in many worlds")
    }
}

/// Shows an error of a circuit's mapping at the place that asks for the circuit.
pub(super) fn for_circuit(error: Diagnostic, place: Span) -> Diagnostic {
    error.with_label(place, "for this circuit")
}

/// Shows an error of a robot file at the library that has it; `command` makes the robots.
pub(super) fn of_library(error: Diagnostic, library: Span, command: Option<&str>) -> Diagnostic {
    let error = error.with_label(library, "the robots of this library");
    command.into_iter().fold(error, Diagnostic::with_help)
}

/// Shows an error of a file at the declaration that names it.
pub(super) fn of_declared_file(error: Diagnostic, declared: Span) -> Diagnostic {
    error.with_label(declared, "declared here")
}

/// A claim that cannot be decided.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum ClaimError {
    /// A circuit without steps, or a property that reads their clock.
    NoSteps { circuit: String, why: NoSteps },
}

impl ClaimError {
    /// The error at the claim.
    pub(super) fn at(self, span: Span) -> Diagnostic {
        let Self::NoSteps { circuit, why } = self;
        let (message, help) = match &why {
            NoSteps::ClockHasNoValue { .. } => (why.to_string(), "leave it out: after each edge it has the same value"),
            NoSteps::OtherSteps => (
                format!("`{circuit}` cannot be compared with this circuit for ever: {why}"),
                "give both the same clock, at the same port",
            ),
            _ => (
                format!("`{circuit}` has no steps: {why}"),
                "a step is an edge of the one clock of all registers, or a row of inputs after which all settles",
            ),
        };
        Diagnostic::new(Code::NoSteps, message, span, "claimed here").with_help(help)
    }
}

/// A swarm that says what the registers of a circuit without memory are made of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct NoRegistersError {
    pub swarm: String,
    pub circuit: String,
}

impl NoRegistersError {
    /// The error at the swarm.
    pub(super) fn at(self, span: Span) -> Diagnostic {
        let Self { swarm, circuit } = self;
        let message = format!("`registers: mux` has no effect in the swarm `{swarm}`");
        Diagnostic::new(Code::NoEffect, message, span, format!("`{circuit}` has no register"))
            .with_help("remove `registers: mux`")
    }
}

/// A library with which an evolution cannot begin: none of its robots fits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct StartError {
    pub evolution: String,
    pub library: String,
}

impl StartError {
    /// The error at the library.
    pub(super) fn at(self, span: Span) -> Diagnostic {
        let Self { evolution, library } = self;
        let message = format!("no robot of `{library}` fits into the box and the materials of `{evolution}`");
        Diagnostic::new(Code::Value, message, span, "the evolution begins with these robots")
    }
}

/// A robot that a library does not have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum RobotNameError {
    /// No robot has the name, perhaps a similar one.
    Unknown { name: String, meant: Suggestion },
    /// No robot has one of the behaviors to which a library is restricted.
    NoBehavior { library: String, absent: Vec<Behavior> },
}

impl RobotNameError {
    /// The error at the name of the robot, or of the library.
    pub(super) fn at(self, span: Span) -> Diagnostic {
        match self {
            Self::Unknown { name, meant } => {
                let message = format!("the library has no robot `{name}`");
                Diagnostic::new(Code::Unknown, message, span, "not in the library").with_suggestion(Some(span), &meant)
            }
            Self::NoBehavior { library, absent } => {
                let names: Vec<&str> = absent.iter().map(|behavior| behavior.function().name()).collect();
                let message = format!("`{library}` has no robot of {}", suggest::alternatives(&names, "or"));
                Diagnostic::new(Code::NoEffect, message, span, "its `behaviors` name what no robot does")
                    .with_help("remove them from `behaviors`; `from: three` has robots of three stimuli")
            }
        }
    }
}

/// A row of a test that is no step of a wave machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum WaveRowError {
    /// A row after the first in which the clock does not make a step.
    NoEdge { clock: String, rises: bool },
    /// A row with a hold of its own, although a step has `step` cycles, or as many as the compiler chooses.
    Hold { step: Option<u32> },
}

impl WaveRowError {
    /// The error at its row.
    pub(super) fn at(self, span: Span) -> Diagnostic {
        match self {
            Self::NoEdge { clock, rises } => {
                let message = "a wave machine shows new outputs only after an edge of its clock";
                let how = if rises { "`^`" } else { "1 in a row and 0 in the next" };
                Diagnostic::new(Code::NoWaves, message, span, format!("`{clock}` makes no step here"))
                    .with_help(format!("only the first row may have no edge; write {how} for `{clock}`"))
            }
            Self::Hold { step } => {
                let message = "a row of a wave machine has no hold of its own";
                let label = match step {
                    Some(step) => format!("a step has {}", counted(step as usize, "cycle")),
                    None => "all steps have the same length".to_owned(),
                };
                Diagnostic::new(Code::NoWaves, message, span, label).with_help("leave out `for`")
            }
        }
    }
}

/// A swarm that may give wrong results.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum SwarmWarning {
    /// A robot of the swarm that makes errors or hardly moves.
    Weak { circuit: String, robot: WeakRobot },
    /// A row that ends before every robot has settled; `path` is the slowest one by static timing.
    ShortHold { hold: usize, needed: usize, path: Vec<String> },
}

impl SwarmWarning {
    /// The warning at the test, its row or its circuit.
    pub(super) fn at(self, span: Span) -> Diagnostic {
        match self {
            Self::Weak { circuit, robot } => {
                let message = format!("`{circuit}` uses the robot `{}`, {}", robot.robot, robot.complaint());
                let help = format!(
                    "it drives {}; a library without it, or a longer hold, may do better",
                    robot.nets.join(", ")
                );
                Diagnostic::new(Code::WeakRobot, message, span, "for this circuit").with_help(help)
            }
            Self::ShortHold { hold, needed, path } => {
                let message = format!("a hold of {} is too short, expected at least {needed}", counted(hold, "cycle"));
                let path = report::describe_path(&path);
                Diagnostic::new(Code::HoldTooShort, message, span, "held here").with_help(format!(
                    "`hold: auto` holds each row until every robot has settled; the slowest path is {path}"
                ))
            }
        }
    }
}

/// A schedule of stimuli that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum ScheduleError {
    /// No entries.
    Empty,
    /// Too many env steps in all.
    TooLong { steps: u64, most: u64 },
    /// An entry without `*`.
    NoDuration { entry: String },
    /// A pattern that has no digit for each stimulus.
    Pattern { found: String },
    /// A set of images that is not declared.
    NoSet { name: String, meant: Suggestion },
    /// A set of images that the body does not sense.
    ImageSize { name: String, found: ImageSize, expected: ImageSize },
    /// One set of images too many.
    TooManySets { most: usize },
    /// A duration that is not a number of cycles or env steps.
    NotADuration { found: String },
    /// A duration of zero.
    NoTime { found: String },
    /// An entry that is too long.
    LongEntry { found: String, most: u64 },
}

/// What the entries of a schedule begin with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ScheduleKind {
    /// A pattern of so many stimuli.
    Pattern { stimuli: usize },
    /// The name of a set of images.
    Set,
}

impl ScheduleError {
    /// The error at its place in the text of a schedule.
    pub(super) fn at(self, span: Span, kind: ScheduleKind) -> Diagnostic {
        let (what, example) = match kind {
            ScheduleKind::Pattern { stimuli } => ("stimuli", format!("{:0>stimuli$}", 1)),
            ScheduleKind::Set => ("a set of images", "zeros".to_owned()),
        };
        let (message, label) = match self {
            Self::Empty => ("the schedule is empty".to_owned(), format!("expected an entry such as `{example}*10`")),
            Self::TooLong { steps, most } => {
                (format!("the schedule of {steps} env steps is too long"), format!("expected at most {most}"))
            }
            Self::NoDuration { entry } => (
                format!("missing duration after `{entry}`"),
                format!("expected `*` and a number, for example `{entry}*10`"),
            ),
            Self::Pattern { found } => {
                let expected = match example.len() {
                    2 => "00, 01, 10 or 11".to_owned(),
                    stimuli => {
                        format!("{stimuli} digits, 0 or 1, for the stimuli that the materials of the body sense")
                    }
                };
                (format!("invalid stimulus pattern `{found}`"), format!("expected {expected}"))
            }
            Self::NoSet { name, meant } => {
                let message = format!("no set of images is called `{name}`");
                return Diagnostic::new(Code::Unknown, message, span, "not declared").with_near(&meant);
            }
            Self::ImageSize { name, found, expected } => (
                format!("the images `{name}` have {found} pixels"),
                format!("the body senses images of {expected} pixels"),
            ),
            Self::TooManySets { most } => {
                ("the schedule shows too many sets of images".to_owned(), format!("expected at most {most}"))
            }
            Self::NotADuration { found } => (
                format!("`{found}` is not a duration"),
                "expected a number of cycles, or of env steps as in `56steps`".to_owned(),
            ),
            Self::NoTime { found } => {
                (format!("the duration `{found}` is too short"), "expected at least 1".to_owned())
            }
            Self::LongEntry { found, most } => {
                (format!("the duration `{found}` is too long"), format!("expected at most {most} env steps"))
            }
        };
        Diagnostic::new(Code::BadSchedule, message, span, label).with_help(format!(
            "write {what}, `*` and a duration: `{example}*10` is ten cycles, `{example}*56steps` is 56 env steps"
        ))
    }
}

/// A test whose rows depend on what the circuit does, and that cannot be performed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum ScriptError {
    /// An environment that cannot be simulated.
    Environment(EnvironmentFault),
    /// A circuit and an environment that never agree.
    NeverAgree,
    /// A line that is no number, or does not fit into a word.
    Line { path: String, line: usize },
    /// A file with more words than the memory.
    TooManyWords { path: String, found: usize, room: usize },
    /// Too many rows for physics.
    TooLong { most: usize },
    /// A file that the program does not declare.
    UnknownFile { name: String, meant: Suggestion },
    /// A file that no memory begins with.
    UnusedFile { name: String },
}

impl ScriptError {
    /// The error at the row, the environment or the file.
    pub(super) fn at(self, span: Span) -> Diagnostic {
        let (code, message, help) = self.words();
        let error = Diagnostic::new(code, message, span, "here");
        help.into_iter().fold(error, Diagnostic::with_help)
    }

    /// The error of a file that the command line names.
    pub(super) fn without_place(self) -> Diagnostic {
        let meant = match &self {
            Self::UnknownFile { meant, .. } => meant.clone(),
            _ => Suggestion::None,
        };
        let (code, message, help) = self.words();
        let error = Diagnostic::without_place(code, message).with_suggestion(None, &meant);
        help.into_iter().fold(error, Diagnostic::with_help)
    }

    fn words(self) -> (Code, String, Option<String>) {
        match self {
            Self::Environment(EnvironmentFault::Clock(error)) => {
                (Code::Operands, format!("the environment cannot be simulated: {error}"), error.help())
            }
            Self::Environment(EnvironmentFault::OtherClock) => (
                Code::Operands,
                "the registers and memories of an environment need one clock, and take their values when it rises"
                    .to_owned(),
                None,
            ),
            Self::Environment(EnvironmentFault::Circle) | Self::NeverAgree => (
                Code::Operands,
                "the circuit and its environment change each other for ever".to_owned(),
                Some("let a register of the environment keep one of the values that go round".to_owned()),
            ),
            Self::Line { path, line } => (
                Code::Value,
                format!("line {line} of `{path}` has no word of the memory"),
                Some("a `.hex` file has hexadecimal words, a `.csv` file numbers, a `.bin` file bytes".to_owned()),
            ),
            Self::TooManyWords { path, found, room } => {
                (Code::TooLarge, format!("`{path}` has {found} words, and the memory {room}"), None)
            }
            Self::TooLong { most } => (
                Code::TooLarge,
                format!("the test has more than {most} rows in physics"),
                Some("test it at the level of logic: `nbc test --logic`".to_owned()),
            ),
            Self::UnknownFile { name, meant } => {
                let declare =
                    || format!("declare it, `file {name} = \"…\"`, and let a memory begin with it: `init {name}`");
                let help = (!matches!(meant, Suggestion::Near(_))).then(declare);
                (Code::Unknown, format!("the program declares no file `{name}`"), help)
            }
            Self::UnusedFile { name } => (
                Code::NoEffect,
                format!("no memory begins with the file `{name}`"),
                Some(format!("let one of an environment do so: `net words[256][8] init {name}`")),
            ),
        }
    }
}
