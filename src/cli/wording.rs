//! Errors of the command line, as data, and their messages. Errors of one command have a wording file beside it.

use nbc_base::diag::suggest::alternatives;
use nbc_base::diag::{Code, Diagnostic, Severity, Suggestion, counted};
use nbc_base::model::{ImageSize, SettingError};

/// A command line that is invalid, or output that cannot be written; `path` is as the user wrote it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::cli) enum UsageError {
    /// Arguments that clap refuses, in its words.
    Arguments { message: String, help: String },
    /// A command line without a command.
    NoCommand,
    /// An argument or a path that is not UTF-8.
    NotText { name: String },
    /// Two files whose robots would have one name.
    SameRobot { name: String },
    /// A file whose name no robot can have.
    RobotName { path: String },
    /// A body that cannot be measured.
    Unstable { path: String, env_step: u32 },
    /// Behaviors that are asked for where only files are given.
    BehaviorOfFile,
    /// Standard output that cannot be written.
    Output { reason: String },
    /// A folder that cannot be listed.
    Unreadable { path: String, reason: String },
    /// Two options that ask for different formats.
    TwoFormats { option: &'static str },
    /// What has no JSON.
    NoJson { what: &'static str },
    /// An unknown code.
    UnknownCode { word: String, meant: Suggestion },
    /// A robot that the library does not have.
    UnknownRobot { name: String, meant: Suggestion },
    /// A file that is named twice.
    TwoFiles { name: String },
    /// A folder without robot files.
    NoRobots { path: String },
    /// A number of threads that is not a number.
    Threads { variable: &'static str, found: String },
    /// A path without a run and without robots.
    NothingToExport { path: String },
    /// A choice of a circuit for a page that has all of them.
    #[cfg(feature = "play")]
    OnlyExported,
    /// A live page, in a program that was built without what it is made of.
    #[cfg(feature = "play")]
    NoLivePages,
    /// A file for a new program that is there already.
    Exists { file: String },
    /// A file for a new program whose name no circuit can have.
    NoWord { file: String },
    /// Witnesses that are asked for where there is not one model.
    WitnessOfSource,
    /// A body that senses images of a size, without a schedule of images.
    NoImages { size: ImageSize },
    /// Images for bodies that sense none.
    NothingSees,
    /// A run where one body is expected, with the behaviors of its bodies.
    BodyOfRun { path: String, behaviors: Vec<String> },
    /// Worlds for tests that run in none.
    NoWorlds,
    /// A ground that a body cannot stand on.
    Setting(SettingError),
}

impl From<UsageError> for Diagnostic {
    fn from(error: UsageError) -> Self {
        let bad = |message: String| Self::without_place(Code::BadValue, message);
        match error {
            UsageError::Arguments { message, help } => bad(message).with_help(help),
            UsageError::NoCommand => {
                bad("the command is missing".to_owned()).with_help("`nbc --help` lists the commands")
            }
            UsageError::NotText { name } => bad(format!("the name `{name}` is not valid UTF-8"))
                .with_help("rename the file or the folder; programs and messages name it as text"),
            UsageError::SameRobot { name } => {
                bad(format!("two robots would be called `{name}`")).with_help("rename one of the files")
            }
            UsageError::RobotName { path } => bad(format!("no robot can have the name of `{path}`"))
                .with_help("a name has letters, digits, `_`, `-`, `+` and `.`, and does not begin with `.`"),
            UsageError::Unstable { path, env_step } => {
                let message = format!("the body in `{path}` is unstable at env step {env_step}");
                Self::without_place(Code::RobotFile, message)
                    .with_help("a body of less swelling or other neighbors may be stable; `nbc simulate` shows it")
            }
            UsageError::BehaviorOfFile => bad("`--behavior` chooses among the robots of runs".to_owned())
                .with_help("leave it out: a robot of your own has the behavior that it has"),
            UsageError::Output { reason } => {
                Self::without_place(Code::Unwritable, format!("cannot write the output: {reason}"))
            }
            UsageError::Unreadable { path, reason } => {
                Self::without_place(Code::Unreadable, format!("cannot read `{path}`: {reason}"))
            }
            UsageError::TwoFormats { option } => {
                bad(format!("`--format json` and `{option}` ask for two formats")).with_help("leave out one")
            }
            UsageError::TwoFiles { name } => {
                bad(format!("the file `{name}` is given twice")).with_help("leave out one")
            }
            UsageError::NoJson { what } => bad(format!("{what} cannot be JSON")).with_help("leave out `--format json`"),
            UsageError::UnknownCode { word, meant } => bad(format!("no message has the code `{word}`"))
                .with_help("`nbc explain` lists the codes")
                .with_near(&meant),
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
            UsageError::NothingToExport { path } => {
                Self::without_place(Code::Empty, format!("`{path}` contains neither a run nor robots"))
                    .with_help("name the folder of a run such as `out/gates`, a folder of robot files, or `shipped`")
            }
            #[cfg(feature = "play")]
            UsageError::OnlyExported => bad("`--circuit` and `--swarm` choose what `--export` writes".to_owned())
                .with_help("add `--export FILE`, or leave them out: the page shows every circuit of the file"),
            #[cfg(feature = "play")]
            UsageError::NoLivePages => bad("this program was built without the page of `--live`".to_owned()).with_help(
                "leave `--live` out for a recording, or build the program with the page (docs/packaging.md)",
            ),
            UsageError::WitnessOfSource => bad("`--witness` is for one model in AIGER's format".to_owned())
                .with_help("leave it out: a property of a program is refuted by a test"),
            UsageError::NoImages { size } => bad(format!("the body senses images of {size} pixels, but is shown none"))
                .with_help(
                    "name a file with sets of images in `--images`, and its sets in `--schedule`, for example \
                     `zeros*250steps`",
                ),
            UsageError::NothingSees => bad("`--images` is for bodies that sense images".to_owned())
                .with_help("leave it out: this body senses patterns of stimuli such as `01`"),
            UsageError::BodyOfRun { path, behaviors } => {
                let bodies = format!("it has bodies with {}", alternatives(&behaviors, "and"));
                bad(format!("`{path}` is a run, expected one `--behavior` of it")).with_help(bodies)
            }
            UsageError::NoWorlds => bad("none of these tests runs in a world".to_owned())
                .with_help("leave out `--vary`: a test for ever is decided at the level of logic"),
            UsageError::Exists { file } => Self::without_place(Code::Unwritable, format!("`{file}` exists already"))
                .with_help("choose another name, or remove the file"),
            UsageError::NoWord { file } => {
                Self::without_place(Code::BadValue, format!("no circuit can have the name of `{file}`"))
                    .with_help("a name has letters, digits and `_`, begins with no digit, and is no reserved word")
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

/// A feature that this program was built without.
#[cfg(not(all(feature = "play", feature = "cluster", feature = "gpu")))]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::cli) struct MissingFeature {
    what: &'static str,
    how: &'static str,
}

#[cfg(not(all(feature = "play", feature = "cluster", feature = "gpu")))]
impl MissingFeature {
    #[cfg(not(feature = "play"))]
    pub(in crate::cli) const PLAY: Self =
        Self { what: "the live page", how: "`cargo build --release`, whose default features include `play`" };
    #[cfg(not(feature = "cluster"))]
    pub(in crate::cli) const CLUSTER: Self =
        Self { what: "work on several machines", how: "`cargo build --release --features cluster`" };
    #[cfg(not(feature = "gpu"))]
    pub(in crate::cli) const GPU: Self = Self { what: "OpenCL devices", how: "`cargo build --release --features gpu`" };
}

#[cfg(not(all(feature = "play", feature = "cluster", feature = "gpu")))]
impl From<MissingFeature> for Diagnostic {
    fn from(MissingFeature { what, how }: MissingFeature) -> Self {
        Self::without_place(Code::BadValue, format!("this program was built without {what}"))
            .with_help(format!("build it with {how}"))
    }
}

/// A robot that left its ground of `width` voxels at that env step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::cli) struct GroundEnds {
    pub(in crate::cli) step: usize,
    pub(in crate::cli) width: usize,
}

impl From<GroundEnds> for Diagnostic {
    fn from(GroundEnds { step, width }: GroundEnds) -> Self {
        let message = format!("the robot walked off the end of its ground at env step {step}");
        let help = format!("give it more than {width} voxels with `--world-width`");
        Self { severity: Severity::Warning, ..Self::without_place(Code::GroundEnds, message).with_help(help) }
    }
}

/// A name that is not among the known ones.
pub(in crate::cli) fn no_such(message: String, name: &str, known: &[String]) -> Diagnostic {
    Diagnostic::without_place(Code::Unknown, message)
        .with_help(format!("there are {}", alternatives(known, "and")))
        .with_near(&Suggestion::near(name, known.iter().map(String::as_str)))
}
