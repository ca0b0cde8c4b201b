//! What can be wrong with files, as data, and how it is worded.

use std::fmt;
use std::io;

use crate::diag::{Code, Diagnostic, counted, folder_error, io_words};
use crate::model::{Behavior, BodyError};
use crate::source::{FileError, Span};

/// A checkpoint that cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum CheckpointError {
    /// Another kind of file.
    NotACheckpoint,
    /// A checkpoint of a format that is not read.
    Format { found: String, expected: &'static str },
    /// Bytes that are not those that were written.
    Damaged,
    /// A search that cannot have been written.
    Unreadable(StateError),
    /// A checkpoint of another seed.
    OtherSeed { found: u64, expected: u64 },
    /// A checkpoint of a declaration that has changed since.
    Changed { evolution: String },
    /// A checkpoint whose bodies or niches the declaration cannot have.
    OtherEvolution { evolution: String },
}

impl CheckpointError {
    /// The error of the file of that name.
    pub(super) fn of(self, file: &str) -> Diagnostic {
        let afresh = "choose another name for the run, or start it afresh without `--resume`";
        let (code, what, help) = match self {
            Self::NotACheckpoint => (Code::Checkpoint, "is not a checkpoint of an evolution run".to_owned(), None),
            Self::Format { found, expected } => (
                Code::ForeignFormat,
                format!("is a checkpoint of format {found}, expected format {expected}"),
                Some("resume it with the version that wrote it"),
            ),
            Self::Damaged => {
                (Code::Checkpoint, "is damaged: its checksum does not match".to_owned(), Some("start the run afresh"))
            }
            Self::Unreadable(error) => (Code::Checkpoint, format!("cannot be read: {error}"), None),
            Self::OtherSeed { found, expected } => {
                (Code::Checkpoint, format!("is of seed {found}, expected seed {expected}"), Some(afresh))
            }
            Self::Changed { evolution } => {
                (Code::Checkpoint, format!("was made by a different declaration of `{evolution}`"), Some(afresh))
            }
            Self::OtherEvolution { evolution } => {
                (Code::Checkpoint, format!("does not belong to evolution `{evolution}`"), Some(afresh))
            }
        };
        let error = Diagnostic::without_place(code, format!("`{file}` {what}"));
        help.into_iter().fold(error, |error, help| error.with_help(help))
    }
}

/// The state of a search that cannot have been written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum StateError {
    /// Another shape than that of a state; the reader's words.
    Shape(String),
    /// A declaration without materials.
    NoMaterials,
    /// An axis of no or too many bins.
    Bins { bins: usize, most: usize },
    /// A niche outside the archive, as its bins.
    NoNiche { bins: Vec<u16> },
    /// An elite whose body is none.
    Body(BodyError),
}

impl fmt::Display for StateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Shape(words) => f.write_str(words),
            Self::NoMaterials => f.write_str("its declaration has no materials"),
            Self::Bins { bins, most } => write!(f, "an axis has {}, expected 1 to {most}", counted(*bins, "bin")),
            Self::NoNiche { bins } => write!(f, "the archive has no niche {bins:?}"),
            Self::Body(error) => write!(f, "an elite has no valid body: {error}"),
        }
    }
}

impl From<serde_json::Error> for StateError {
    fn from(error: serde_json::Error) -> Self {
        Self::Shape(error.to_string())
    }
}

/// A robot file that cannot be used.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum RobotFileError {
    /// More text than is read.
    TooLarge { most: u64 },
    /// Brackets inside brackets.
    TooDeep { most: usize },
    /// Text that is not YAML of a robot; the reader's words.
    Shape(String),
    /// A file of another version.
    Format { found: u32, expected: u32 },
    /// Rows that are not a body.
    Body(BodyError),
    /// A body of several pieces.
    TwoPieces,
    /// Numbers and words that no robot has.
    Flaw(Flaw),
}

impl RobotFileError {
    /// The error of the file of that name, at its place in the file where it has one.
    pub(super) fn of(self, file: &str, span: impl Into<Option<Span>>) -> Diagnostic {
        let (code, message, label) = match &self {
            Self::TooLarge { most } => {
                (Code::RobotFile, format!("`{file}` is not a robot file: larger than {most} bytes"), "here")
            }
            Self::TooDeep { most } => (
                Code::RobotFile,
                format!("`{file}` is not a robot file: brackets are nested more than {most} levels deep"),
                "the limit is reached here",
            ),
            Self::Shape(words) => (Code::RobotFile, format!("`{file}` is not a robot file: {words}"), "here"),
            Self::Format { found, expected } => (
                Code::ForeignFormat,
                format!("`{file}` is a robot file of format {found}, expected format {expected}"),
                "written by another version of nbc",
            ),
            Self::Body(error) => (Code::RobotFile, format!("`{file}` has no valid body: {error}"), "here"),
            Self::TwoPieces => (Code::RobotFile, format!("the body in `{file}` is not in one piece"), "this body"),
            Self::Flaw(flaw) => (Code::RobotFile, format!("`{file}` is not a valid robot file: {flaw}"), "here"),
        };
        let error = match span.into() {
            Some(span) => Diagnostic::new(code, message, span, label),
            None => Diagnostic::without_place(code, message),
        };
        match self {
            Self::Body(_) => error.with_help("a body is a rectangle of material codes, top row first, 0 for empty"),
            Self::TwoPieces => error.with_help("the voxels of a robot are connected by their sides"),
            _ => error,
        }
    }
}

/// An error of a file that needs nothing but a body, with an example of one.
pub(super) fn with_body_example(error: Diagnostic) -> Diagnostic {
    error.with_help("write the body's rows, top row first: `body: [\"00345\", \"33333\"]`")
}

/// What no measurement of a robot gives.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Flaw {
    /// A name that cannot be one of a file.
    Name { name: String, most: usize },
    /// A word of the provenance that is too long or has control characters.
    Provenance { field: &'static str, most: usize },
    /// A displacement that is not finite.
    Displacement,
    /// A behavior that is not that of the displacements.
    Behavior { found: Behavior, expected: Behavior },
    /// A clock of no or too many cycles.
    Clock { cycles: u32, most: u32 },
    /// A share outside 0 to 1.
    Rate { field: &'static str, rate: f64 },
    /// A margin that is not finite.
    Margin,
    /// A settle time of no or too many cycles.
    Settle { cycles: u32, most: u32 },
    /// A weight of the genotype that is not finite.
    Weight,
}

impl Flaw {
    /// The field with the flaw.
    pub(super) fn field(&self) -> &'static str {
        match self {
            Self::Name { .. } => "name",
            Self::Provenance { field, .. } | Self::Rate { field, .. } => field,
            Self::Displacement => "displacement",
            Self::Behavior { .. } => "behavior",
            Self::Clock { .. } => "clock",
            Self::Margin => "margin",
            Self::Settle { .. } => "settle",
            Self::Weight => "genotype",
        }
    }
}

impl fmt::Display for Flaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Name { name, most } => {
                write!(f, "invalid name `{name}`; expected up to {most} letters, digits, `_`, `-`, `+` and `.`")
            }
            Self::Provenance { field, most } => {
                write!(f, "`{field}` is longer than {most} bytes or has control characters")
            }
            Self::Displacement => f.write_str("a displacement is not a finite number"),
            Self::Behavior { found, expected } => {
                write!(f, "behavior `{found}`, but the displacements are those of `{expected}`")
            }
            Self::Clock { cycles, most } => write!(f, "a clock of {cycles} cycles, expected 1 to {most}"),
            Self::Rate { field, rate } => write!(f, "`{field}` of {rate}, expected a share from 0 to 1"),
            Self::Margin => f.write_str("the margin is not a finite number"),
            Self::Settle { cycles, most } => write!(f, "a settle time of {cycles} cycles, expected 1 to {most}"),
            Self::Weight => f.write_str("a weight of the network is not a finite number"),
        }
    }
}

/// A circuit file, or a library, that cannot be read or written.
#[derive(Debug)]
pub(super) enum StoreError {
    /// A name that ends as no circuit file's does.
    CircuitFormat { file: String },
    /// A circuit of more text than is read again.
    NbTooLarge { bytes: usize, most: u64 },
    /// No folder to work in.
    TemporaryFolder(io::Error),
    /// No Yosys.
    YosysMissing,
    /// Yosys without a result.
    YosysSilent { file: String },
    /// Yosys with an error of its own, at a place of the file where it names one.
    Yosys { file: String, reason: String, place: Option<Span> },
    /// A folder of robots.
    Library { folder: String, error: FileError },
}

impl From<StoreError> for Diagnostic {
    fn from(error: StoreError) -> Self {
        match error {
            StoreError::CircuitFormat { file } => {
                let message =
                    format!("unrecognized circuit format of `{file}`; expected .blif, .aig, .aag, .bench or .v");
                Self::without_place(Code::BadValue, message)
            }
            StoreError::NbTooLarge { bytes, most } => {
                Self::without_place(Code::TooLarge, format!("the circuit takes {bytes} bytes as a .nb file"))
                    .with_help(format!("a .nb file has at most {most} bytes; write BLIF"))
            }
            StoreError::TemporaryFolder(error) => {
                let message = format!("cannot write a temporary folder: {}", io_words(&error));
                Self::without_place(Code::Unwritable, message)
            }
            StoreError::YosysMissing => {
                Self::without_place(Code::Unreadable, "Verilog is read through Yosys, which is not installed")
                    .with_help("install it, on Debian with `apt-get install yosys`, or give a BLIF file")
            }
            StoreError::YosysSilent { file } => {
                Self::without_place(Code::CircuitFile, format!("yosys made no BLIF of `{file}`"))
            }
            StoreError::Yosys { file, reason, place } => {
                let message = format!("yosys cannot read `{file}`");
                match place {
                    Some(span) => Self::new(Code::CircuitFile, message, span, reason),
                    None => Self::without_place(Code::CircuitFile, format!("{message}: {reason}")),
                }
            }
            StoreError::Library { folder, error } => {
                let message = format!("cannot read the library `{folder}`: {}", folder_error(&error));
                Self::without_place(Code::Unreadable, message)
            }
        }
    }
}
