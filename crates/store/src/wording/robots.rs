//! Robot files and folders of them.

use std::fmt;

use nbc_base::diag::{Code, Diagnostic, folder_error};
use nbc_base::model::{Behavior, BodyError};
use nbc_base::source::{FileError, Span};

/// A robot file that cannot be used.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum RobotFileError {
    /// Too much text.
    TooLarge { most: u64 },
    /// Too much text, that of aliases counted each time.
    TooMuch { most: u64 },
    /// Brackets that are nested too deeply.
    TooDeep { most: u64 },
    /// Text that is not the YAML of a robot, in the words of the reader.
    Shape(String),
    /// A file of another version.
    Format { found: u32, expected: u32 },
    /// Rows that are not a body.
    Body(BodyError),
    /// A body of several pieces.
    TwoPieces,
    /// A value that a robot cannot have.
    Flaw(Flaw),
}

impl RobotFileError {
    /// The error of the file of that name, at its place in the file if it has one.
    pub(crate) fn of(self, file: &str, span: impl Into<Option<Span>>) -> Diagnostic {
        let (code, message, label) = match &self {
            Self::TooLarge { most } => {
                (Code::RobotFile, format!("`{file}` is not a robot file: larger than {most} bytes"), "here")
            }
            Self::TooMuch { most } => (
                Code::RobotFile,
                format!("`{file}` is not a robot file: with its aliases it has more than {most} bytes of text"),
                "here",
            ),
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

/// Adds an example of a body to an error of a file that needs only a body.
pub(crate) fn with_body_example(error: Diagnostic) -> Diagnostic {
    error.with_help("write the body's rows, top row first: `body: [\"00345\", \"33333\"]`")
}

/// A value that a measurement of a robot cannot give.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Flaw {
    /// A name that cannot be part of a file name.
    Name { name: String, most: usize },
    /// A word of the provenance that is too long or has control characters.
    Provenance { field: &'static str, most: usize },
    /// A displacement that is not finite.
    Displacement,
    /// A behavior that contradicts the displacements.
    Behavior { found: Behavior, expected: Behavior },
    /// A clock of zero or too many cycles.
    Clock { cycles: u32, most: u32 },
    /// A share outside 0 to 1.
    Rate { field: &'static str, rate: f64 },
    /// A margin that is not finite.
    Margin,
    /// A radius that is not finite, or of changes that cannot be read.
    Radius,
    /// A settle time of zero or too many cycles.
    Settle { cycles: u32, most: u32 },
    /// A weight of the genotype that is not finite.
    Weight,
}

impl Flaw {
    /// The field with the flaw.
    pub(crate) fn field(&self) -> &'static str {
        match self {
            Self::Name { .. } => "name",
            Self::Provenance { field, .. } | Self::Rate { field, .. } => field,
            Self::Displacement => "displacement",
            Self::Behavior { .. } => "behavior",
            Self::Clock { .. } => "clock",
            Self::Margin => "margin",
            Self::Radius => "radius",
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
            Self::Radius => f.write_str("the radius is not a finite number of changes such as `friction=10%`"),
            Self::Settle { cycles, most } => write!(f, "a settle time of {cycles} cycles, expected 1 to {most}"),
            Self::Weight => f.write_str("a weight of the network is not a finite number"),
        }
    }
}

/// A folder of robots that cannot be listed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct LibraryError {
    pub(crate) folder: String,
    pub(crate) error: FileError,
}

impl From<LibraryError> for Diagnostic {
    fn from(LibraryError { folder, error }: LibraryError) -> Self {
        let message = format!("cannot read the library `{folder}`: {}", folder_error(&error));
        Self::without_place(Code::Unreadable, message)
    }
}
