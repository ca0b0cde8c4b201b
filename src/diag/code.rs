//! The codes of diagnostics: one for each rule, each with a page under `docs/errors/`.

use std::fmt;

use serde::{Serialize, Serializer};

use super::Severity;

/// A rule that input can break.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Code {
    /// A schedule on the command line that is none.
    BadSchedule,
    /// An option's value that makes no sense.
    BadValue,
    /// A circuit file (BLIF, AIGER, .bench, Verilog) that is damaged, or says what cannot be built.
    CircuitFile,
    /// A file of another version of the program.
    ForeignFormat,
    /// A cell library that does not hold enough functions.
    IncompleteLibrary,
    /// A robot file that is damaged, or none.
    RobotFile,
    /// The text does not follow the grammar.
    Syntax,
    /// A name that no robot of the library has.
    UnknownRobot,
    /// A file that cannot be read as source text.
    Unreadable,
    /// A file or folder that cannot be written.
    Unwritable,
}

impl Code {
    /// All codes, in alphabetical order of their words.
    pub const ALL: &[Self] = &[
        Self::BadSchedule,
        Self::BadValue,
        Self::CircuitFile,
        Self::ForeignFormat,
        Self::IncompleteLibrary,
        Self::RobotFile,
        Self::Syntax,
        Self::UnknownRobot,
        Self::Unreadable,
        Self::Unwritable,
    ];

    /// The code as users write it, for `nbc explain`.
    pub fn word(self) -> &'static str {
        match self {
            Self::BadSchedule => "bad-schedule",
            Self::BadValue => "bad-value",
            Self::CircuitFile => "circuit-file",
            Self::ForeignFormat => "foreign-format",
            Self::IncompleteLibrary => "incomplete-library",
            Self::RobotFile => "robot-file",
            Self::Syntax => "syntax",
            Self::UnknownRobot => "unknown-robot",
            Self::Unreadable => "unreadable",
            Self::Unwritable => "unwritable",
        }
    }

    /// How bad it is.
    pub fn severity(self) -> Severity {
        match self {
            Self::BadSchedule
            | Self::BadValue
            | Self::CircuitFile
            | Self::ForeignFormat
            | Self::IncompleteLibrary
            | Self::RobotFile
            | Self::Syntax
            | Self::UnknownRobot
            | Self::Unreadable
            | Self::Unwritable => Severity::Error,
        }
    }
}

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.word())
    }
}

impl Serialize for Code {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.word())
    }
}
