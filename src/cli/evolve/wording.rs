//! Errors of evolution runs and their folders, and the messages.

use nbc_base::diag::suggest::alternatives;
use nbc_base::diag::{Code, Diagnostic, Severity};

use crate::cli::wording::no_such;

/// A run that cannot be chosen, opened or read; `path`, `file` and `folder` are as the user wrote them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::cli) enum EvolveError {
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

impl From<EvolveError> for Diagnostic {
    fn from(error: EvolveError) -> Self {
        let fault = Self::without_place;
        match error {
            EvolveError::NoEvolution { file, known } => fault(Code::Unknown, format!("`{file}` declares no evolution"))
                .with_help(format!("run one that it uses with `--run`: {}", alternatives(&known, "or"))),
            EvolveError::UnknownEvolution { name, known } => {
                no_such(format!("no evolution is called `{name}`"), &name, &known)
            }
            EvolveError::Held { folder, process } => {
                let who = process.map_or_else(|| "another process".to_owned(), |process| format!("process {process}"));
                fault(Code::Unwritable, format!("`{folder}` is in use by {who}"))
                    .with_help("wait until it has ended, or choose another folder with `--out`")
            }
            EvolveError::HasRun { folder } => fault(Code::Checkpoint, format!("`{folder}` already contains a run"))
                .with_help("continue it with `--resume`, or choose another folder with `--out`"),
            EvolveError::NoRobotFound => fault(Code::Empty, "no run found a robot".to_owned())
                .with_help("the summary tells what became of the bodies; more generations or a larger box may help"),
            EvolveError::NoCheckpoint { path } => fault(Code::Checkpoint, format!("there is no checkpoint `{path}`"))
                .with_help(
                    "name the folder of a run such as `out/gates`, or of one of its seeds such as `out/gates/seed-1`",
                ),
        }
    }
}

/// Lines of past generations that are missing in a file of progress.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::cli) enum ProgressGaps {
    /// Curves are drawn without them.
    InCurves { path: String, damage: String },
    /// The run is resumed without them; `aside` is the path of the damaged file.
    InRun { path: String, damage: String, aside: Option<String> },
}

impl From<ProgressGaps> for Diagnostic {
    fn from(gaps: ProgressGaps) -> Self {
        let (path, damage, help) = match gaps {
            ProgressGaps::InCurves { path, damage } => (path, damage, "curves over time leave them out".to_owned()),
            ProgressGaps::InRun { path, damage, aside } => {
                let kept = aside.map_or_else(String::new, |aside| format!("; the damaged file is kept as `{aside}`"));
                (path, damage, format!("the run continues without them{kept}"))
            }
        };
        let message = format!("`{path}` {damage}");
        Self { severity: Severity::Warning, ..Self::without_place(Code::Checkpoint, message).with_help(help) }
    }
}
