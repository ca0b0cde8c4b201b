//! Checkpoints of evolution runs.

use std::fmt;

use nbc_base::diag::{Code, Diagnostic, counted};
use nbc_base::model::{Behavior, BodyError};

/// A checkpoint that cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum CheckpointError {
    /// Another kind of file.
    NotACheckpoint,
    /// A checkpoint of an unsupported format.
    Format { found: String, expected: &'static str },
    /// Damaged bytes.
    Damaged,
    /// An impossible state of a search.
    Unreadable(StateError),
    /// A checkpoint of another swarm or other inputs.
    OtherSwarm,
    /// A checkpoint of another seed.
    OtherSeed { found: u64, expected: u64 },
    /// A checkpoint of a declaration that has changed since.
    Changed { evolution: String },
    /// A checkpoint with bodies or niches that do not belong to the declaration.
    OtherEvolution { evolution: String },
}

impl CheckpointError {
    /// The error of the file of that name.
    pub(crate) fn of(self, file: &str) -> Diagnostic {
        let afresh = "choose another name for the run, or start it again without `--resume`";
        let (code, what, help) = match self {
            Self::NotACheckpoint => (Code::Checkpoint, "is not a checkpoint of such a run".to_owned(), None),
            Self::OtherSwarm => (
                Code::Checkpoint,
                "belongs to another swarm or other rows".to_owned(),
                Some("choose another folder, or remove the file"),
            ),
            Self::Format { found, expected } => (
                Code::ForeignFormat,
                format!("is a checkpoint of format {found}, expected format {expected}"),
                Some("resume it with the version that wrote it"),
            ),
            Self::Damaged => {
                (Code::Checkpoint, "is damaged: its checksum does not match".to_owned(), Some("start the run again"))
            }
            Self::Unreadable(error) => (Code::Checkpoint, format!("cannot be read: {error}"), None),
            Self::OtherSeed { found, expected } => {
                (Code::Checkpoint, format!("belongs to seed {found}, expected seed {expected}"), Some(afresh))
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

/// An impossible state of a search.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum StateError {
    /// Data that is not a state, in the words of the reader.
    Shape(String),
    /// A declaration without materials.
    NoMaterials,
    /// An axis without bins, or with too many.
    Bins { bins: usize, most: usize },
    /// A niche outside the archive, as its bins.
    NoNiche { bins: Vec<u16> },
    /// An elite whose behavior or displacements are of another number of stimuli than its declaration has.
    Stimuli { behavior: Behavior, stimuli: usize },
    /// An elite with an invalid body.
    Body(BodyError),
}

impl fmt::Display for StateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Shape(words) => f.write_str(words),
            Self::NoMaterials => f.write_str("its declaration has no materials"),
            Self::Bins { bins, most } => write!(f, "an axis has {}, expected 1 to {most}", counted(*bins, "bin")),
            Self::NoNiche { bins } => write!(f, "the archive has no niche {bins:?}"),
            Self::Stimuli { behavior, stimuli } => {
                write!(f, "an elite has the behavior {behavior}, expected one of {stimuli} stimuli")
            }
            Self::Body(error) => write!(f, "an elite has no valid body: {error}"),
        }
    }
}

impl From<serde_json::Error> for StateError {
    fn from(error: serde_json::Error) -> Self {
        Self::Shape(error.to_string())
    }
}
