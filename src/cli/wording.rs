//! What can be wrong with a command line, as data, and how it is worded.

use nbc_base::diag::suggest::alternatives;
use nbc_base::diag::{Code, Diagnostic, Severity, Suggestion, counted};
use nbc_base::model::{Behavior, SettingError};
#[cfg(feature = "gpu")]
use nbc_sim::DeviceError;

/// A command line that is invalid, or output that cannot be written; `path` is as the user wrote it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::cli) enum UsageError {
    /// Standard output that cannot be written.
    Output { reason: String },
    /// A folder that cannot be listed.
    Unreadable { path: String, reason: String },
    /// Two options that ask for different formats.
    TwoFormats { option: &'static str },
    /// A completion script as JSON.
    CompletionsJson,
    /// A file name without the extension of a circuit format.
    CircuitFormat { path: String },
    /// An unknown code.
    UnknownCode { word: String, meant: Suggestion },
    /// An unknown function.
    UnknownFunction { name: String, known: Vec<&'static str> },
    /// A robot that the library does not have.
    UnknownRobot { name: String, meant: Suggestion },
    /// A folder without robot files.
    NoRobots { path: String },
    /// A number of threads that is not a number.
    Threads { variable: &'static str, found: String },
    /// A ground that a body cannot stand on.
    Setting(SettingError),
}

/// A live page asked for in a program that was built without it.
#[cfg(not(feature = "play"))]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::cli) struct NoPage;

#[cfg(not(feature = "play"))]
impl From<NoPage> for Diagnostic {
    fn from(_: NoPage) -> Self {
        Self::without_place(Code::BadValue, "this program was built without the live page")
            .with_help("build it with `cargo build --release`, whose default features include `play`")
    }
}

/// Work on several machines asked of a program that was built without it.
#[cfg(not(feature = "cluster"))]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::cli) struct NoCluster;

#[cfg(not(feature = "cluster"))]
impl From<NoCluster> for Diagnostic {
    fn from(_: NoCluster) -> Self {
        Self::without_place(Code::BadValue, "this program was built without work on several machines")
            .with_help("build it with `cargo build --release --features cluster`")
    }
}

/// A device asked for in a program that was built without them.
#[cfg(not(feature = "gpu"))]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::cli) struct NoDevices;

#[cfg(not(feature = "gpu"))]
impl From<NoDevices> for Diagnostic {
    fn from(_: NoDevices) -> Self {
        Self::without_place(Code::BadValue, "this program was built without OpenCL devices")
            .with_help("build it with `cargo build --release --features gpu`")
    }
}

/// A device that the user asked for and that cannot be used.
#[cfg(feature = "gpu")]
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::cli) struct DeviceFailure(pub(in crate::cli) DeviceError);

#[cfg(feature = "gpu")]
impl From<DeviceFailure> for Diagnostic {
    fn from(DeviceFailure(error): DeviceFailure) -> Self {
        let fault = |message: String, help: &str| Self::without_place(Code::BadValue, message).with_help(help);
        let processor = "`--device cpu` simulates on this processor, with the same results";
        match error {
            DeviceError::NoDriver => fault(
                "no OpenCL driver was found".to_owned(),
                "install the driver of the card, or `pocl-opencl-icd` for this processor; docs/gpu.md says how",
            ),
            DeviceError::NoDevice => fault("the OpenCL driver has no device".to_owned(), processor),
            DeviceError::UnknownDevice { number, devices } => fault(
                format!("there is no device `gpu:{number}`, expected a number below {devices}"),
                "`nbc devices` lists them",
            ),
            DeviceError::NoDoubles { device } => {
                fault(format!("`{device}` has no numbers of double precision"), processor)
            }
            DeviceError::Rejected { device, log } => {
                fault(format!("the driver of `{device}` cannot compile the kernel: {}", log.trim()), processor)
            }
            DeviceError::Differs { device } => {
                fault(format!("the results of `{device}` are not those of this processor"), processor)
            }
            DeviceError::OutOfMemory { device } => {
                fault(format!("`{device}` has not enough free memory"), "end other programs that use it")
            }
            DeviceError::Lost { device, reason } => fault(format!("`{device}` failed: {reason}"), processor),
        }
    }
}

/// The same when this processor takes over.
#[cfg(feature = "gpu")]
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::cli) struct DeviceWarning(pub(in crate::cli) DeviceError);

#[cfg(feature = "gpu")]
impl From<DeviceWarning> for Diagnostic {
    fn from(DeviceWarning(error): DeviceWarning) -> Self {
        let message = Self::from(DeviceFailure(error)).message;
        let warning = Self::without_place(Code::BadValue, message);
        Self {
            severity: Severity::Warning,
            ..warning.with_help("this processor simulates instead, with the same results")
        }
    }
}

impl From<UsageError> for Diagnostic {
    fn from(error: UsageError) -> Self {
        let bad = |message: String| Self::without_place(Code::BadValue, message);
        match error {
            UsageError::Output { reason } => {
                Self::without_place(Code::Unwritable, format!("cannot write the output: {reason}"))
            }
            UsageError::Unreadable { path, reason } => {
                Self::without_place(Code::Unreadable, format!("cannot read `{path}`: {reason}"))
            }
            UsageError::TwoFormats { option } => {
                bad(format!("`--format json` and `{option}` ask for two formats")).with_help("leave out one")
            }
            UsageError::CompletionsJson => {
                bad("a completion script cannot be JSON".to_owned()).with_help("leave out `--format json`")
            }
            UsageError::CircuitFormat { path } => {
                bad(format!("unrecognized circuit format of `{path}`; expected .blif, .aig, .aag, .v, .dot or .nb"))
            }
            UsageError::UnknownCode { word, meant } => bad(format!("no message has the code `{word}`"))
                .with_help("`nbc explain` lists the codes")
                .with_near(&meant),
            UsageError::UnknownFunction { name, known } => bad(format!("`{name}` is not a function of two inputs"))
                .with_help(format!("the functions are {}", known.join(", ")))
                .with_near(&Suggestion::near(&name, known)),
            UsageError::UnknownRobot { name, meant } => {
                Self::without_place(Code::UnknownRobot, format!("no robot of the library is called `{name}`"))
                    .with_help("`nbc library list` lists the robots; a function such as `nand` means its best one")
                    .with_near(&meant)
            }
            UsageError::NoRobots { path } => {
                Self::without_place(Code::Empty, format!("`{path}` contains no robot files (.yaml)"))
                    .with_help("`nbc library add RUN --into DIR` writes robot files")
            }
            UsageError::Threads { variable, found } => {
                bad(format!("the environment variable `{variable}` is `{found}`, expected a number of threads"))
                    .with_help("unset it to use every core")
            }
            UsageError::Setting(SettingError::WideWorld { width, most }) => {
                bad(format!("`--world-width {width}` is too wide, expected at most {most}"))
            }
            UsageError::Setting(SettingError::NarrowWorld { width, columns }) => {
                bad(format!("`--world-width {width}` is too narrow for a body of {}", counted(columns, "column")))
            }
            UsageError::Setting(SettingError::OffGround { start, most, columns, width }) => bad(format!(
                "`--start-x {start}` is off the ground, expected at most {most} for {} on {}",
                counted(columns, "column"),
                counted(width, "voxel")
            )),
        }
    }
}

/// A file or folder that a command cannot use; `path`, `file` and `folder` are as the user wrote them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::cli) enum SubjectError {
    /// A path without a run and without robots.
    NothingToExport { path: String },
    /// A file for a new program that is there already.
    Exists { file: String },
    /// A file for a new program whose name no circuit can have.
    NoWord { file: String },
    /// A file without tests.
    NoTest { file: String },
    /// A file without tests and simulations.
    NothingToRun { file: String },
    /// A test or simulation that the file does not have.
    UnknownRun { file: String, name: String, known: Vec<String> },
    /// A file without evolutions of its own.
    NoEvolution { file: String, known: Vec<String> },
    /// An evolution that the file does not have.
    UnknownEvolution { name: String, known: Vec<String> },
    /// A folder that another process writes.
    Held { folder: String, process: Option<u32> },
    /// A folder with a run in it.
    HasRun { folder: String },
    /// Runs whose archives are empty.
    NoRobotFound,
    /// A folder without a checkpoint.
    NoCheckpoint { path: String },
}

impl From<SubjectError> for Diagnostic {
    fn from(error: SubjectError) -> Self {
        let fault = Self::without_place;
        match error {
            SubjectError::NothingToExport { path } => {
                fault(Code::Empty, format!("`{path}` contains neither a run nor robots"))
                    .with_help("name the folder of a run such as `out/gates`, a folder of robot files, or `shipped`")
            }
            SubjectError::Exists { file } => fault(Code::Unwritable, format!("`{file}` exists already"))
                .with_help("choose another name, or remove the file"),
            SubjectError::NoWord { file } => fault(Code::BadValue, format!("no circuit can have the name of `{file}`"))
                .with_help("a name has letters, digits and `_`, begins with no digit, and is no reserved word"),
            SubjectError::NoTest { file } => fault(Code::Empty, format!("`{file}` declares no test"))
                .with_help("declare one: `test my_circuit { a b | q` and a row for each input pattern"),
            SubjectError::NothingToRun { file } => {
                let message = format!("`{file}` declares no test and no simulation, so there is nothing to run");
                let help = "declare a test: `test my_circuit { a b | q` and a row for each input pattern; \
                            `nbc check` only checks";
                fault(Code::Empty, message).with_help(help)
            }
            SubjectError::UnknownRun { file, name, known } => {
                let message = format!("no test and no simulation of `{file}` is called `{name}`");
                no_such(message, &name, &known)
            }
            SubjectError::NoEvolution { file, known } => {
                fault(Code::Unknown, format!("`{file}` declares no evolution"))
                    .with_help(format!("run one that it uses with `--run`: {}", alternatives(&known, "or")))
            }
            SubjectError::UnknownEvolution { name, known } => {
                no_such(format!("no evolution is called `{name}`"), &name, &known)
            }
            SubjectError::Held { folder, process } => {
                let who = process.map_or_else(|| "another process".to_owned(), |process| format!("process {process}"));
                fault(Code::Unwritable, format!("`{folder}` is in use by {who}"))
                    .with_help("wait until it has ended, or choose another folder with `--out`")
            }
            SubjectError::HasRun { folder } => fault(Code::Checkpoint, format!("`{folder}` already contains a run"))
                .with_help("continue it with `--resume`, or choose another folder with `--out`"),
            SubjectError::NoRobotFound => fault(Code::Empty, "no run found a robot".to_owned())
                .with_help("the summary tells what became of the bodies; more generations or a larger box may help"),
            SubjectError::NoCheckpoint { path } => fault(Code::Checkpoint, format!("there is no checkpoint `{path}`"))
                .with_help(
                    "name the folder of a run such as `out/gates`, or of one of its seeds such as `out/gates/seed-1`",
                ),
        }
    }
}

/// A problem of a run that does not stop it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::cli) enum RunWarning {
    /// A file of progress without lines of past generations, when curves are drawn.
    GapsInCurves { path: String, damage: String },
    /// The same when the run is resumed; `aside` is the path of the damaged file.
    GapsInRun { path: String, damage: String, aside: Option<String> },
    /// A robot that left its ground at that env step.
    GroundEnds { step: usize, width: usize },
}

impl From<RunWarning> for Diagnostic {
    fn from(warning: RunWarning) -> Self {
        let (code, message, help) = match warning {
            RunWarning::GapsInCurves { path, damage } => {
                (Code::Checkpoint, format!("`{path}` {damage}"), "curves over time leave them out".to_owned())
            }
            RunWarning::GapsInRun { path, damage, aside } => {
                let kept = aside.map_or_else(String::new, |aside| format!("; the damaged file is kept as `{aside}`"));
                (Code::Checkpoint, format!("`{path}` {damage}"), format!("the run continues without them{kept}"))
            }
            RunWarning::GroundEnds { step, width } => (
                Code::GroundEnds,
                format!("the robot walked off the end of its ground at env step {step}"),
                format!("give it more than {width} voxels with `--world-width`"),
            ),
        };
        Self { severity: Severity::Warning, ..Self::without_place(code, message).with_help(help) }
    }
}

/// A picture that cannot be drawn as requested; `what` is the subject as the user named it.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::cli) enum DrawError {
    /// A file name without an extension of that kind of picture.
    Extension { path: String, expected: Vec<String>, kind: &'static str },
    /// A kind of picture that the subject does not have.
    Kind { what: String, given: &'static str, expected: &'static str, kind: &'static str },
    /// An option that would have no effect.
    Option { what: String, option: &'static str, kind: &'static str, applies_to: &'static str },
    /// A moment after the end of the schedule.
    AfterEnd { at: f64, end: f64 },
    /// A behavior without a robot.
    UnknownBehavior { what: String, behavior: Behavior },
    /// A file or circuit without tests and simulations.
    NoRun { what: String },
    /// A test that the file does not have.
    UnknownTest { file: String, name: String, known: Vec<String> },
    /// A net that is not driven by a robot.
    UnknownNet { net: String, known: Vec<String> },
    /// A folder without a run.
    NoRunInFolder { folder: String },
    /// A checkpoint of an old version, without its axes.
    NoAxes { path: String },
    /// A checkpoint of a different declaration than those before it.
    OtherDeclaration { path: String },
    /// A second checkpoint of a seed.
    SameSeed { path: String, seed: u64 },
    /// A number of axes other than two.
    AxisCount { found: usize, axes: Vec<String> },
    /// An axis that the archive does not have.
    UnknownAxis { name: String, axes: Vec<String> },
    /// The same axis twice.
    SameAxis { name: String, axes: Vec<String> },
}

impl From<DrawError> for Diagnostic {
    fn from(error: DrawError) -> Self {
        let bad = |message: String| Self::without_place(Code::BadValue, message);
        let unknown = |message: String| Self::without_place(Code::Unknown, message);
        let run = |message: String, help: &str| Self::without_place(Code::Checkpoint, message).with_help(help);
        match error {
            DrawError::Extension { path, expected, kind } => bad(format!(
                "unrecognized picture format of `{path}`; expected a name that ends in {} for `--as {kind}`",
                expected.join(" or ")
            )),
            DrawError::Kind { what, given, expected, kind } => {
                bad(format!("`{what}` is {given}, expected {expected} for `--as {kind}`"))
            }
            DrawError::Option { what, option, kind, applies_to } => {
                bad(format!("`{option}` does not apply to `{what}` drawn as `{kind}`"))
                    .with_help(format!("it is for {applies_to}"))
            }
            DrawError::AfterEnd { at, end } => {
                bad(format!("`--at {at}` is after the end of the schedule at cycle {end}"))
            }
            DrawError::UnknownBehavior { what, behavior } => {
                unknown(format!("`{what}` has no robot of the behavior `{behavior}`"))
            }
            DrawError::NoRun { what } => {
                let message = format!("`{what}` has no test and no simulation, so there is no run to draw");
                Self::without_place(Code::Empty, message).with_help("`--as schematic` and `--as dot` need none")
            }
            DrawError::UnknownTest { file, name, known } => {
                no_such(format!("no test of `{file}` is called `{name}`"), &name, &known)
            }
            DrawError::UnknownNet { net, known } => unknown(format!("no robot drives `{net}`"))
                .with_help(format!("the robots drive {}", alternatives(&known, "and")))
                .with_near(&Suggestion::near(&net, known.iter().map(String::as_str))),
            DrawError::AxisCount { found, axes } => {
                with_axes(bad(format!("{found} axes were given, expected two such as `voxels,active`")), &axes)
            }
            DrawError::UnknownAxis { name, axes } => {
                with_axes(bad(format!("`{name}` is not an axis of this archive")), &axes)
                    .with_near(&Suggestion::near(&name, axes.iter().map(String::as_str)))
            }
            DrawError::SameAxis { name, axes } => {
                with_axes(bad(format!("both axes are `{name}`, expected two different ones")), &axes)
            }
            DrawError::NoRunInFolder { folder } => {
                run(format!("`{folder}` contains no run"), "name the folder of a run, such as `out/gates`")
            }
            DrawError::NoAxes { path } => {
                run(format!("`{path}` does not say the axes of its archive"), "`nbc evolve --resume` writes them")
            }
            DrawError::OtherDeclaration { path } => run(
                format!("`{path}` was made by a different declaration than the runs beside it"),
                "draw the folder of one seed",
            ),
            DrawError::SameSeed { path, seed } => run(
                format!("`{path}` has seed {seed}, like another run in the folder"),
                "each run counts once; move the copy out of the folder",
            ),
        }
    }
}

/// A name that is not among the known ones.
fn no_such(message: String, name: &str, known: &[String]) -> Diagnostic {
    Diagnostic::without_place(Code::Unknown, message)
        .with_help(format!("there are {}", alternatives(known, "and")))
        .with_near(&Suggestion::near(name, known.iter().map(String::as_str)))
}

fn with_axes(error: Diagnostic, axes: &[String]) -> Diagnostic {
    error.with_help(format!("the archive has the axes {}", alternatives(axes, "and")))
}
