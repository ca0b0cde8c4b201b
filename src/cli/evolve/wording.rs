//! Errors of evolution runs and their folders, and the messages.

use nbc_base::diag::suggest::alternatives;
use nbc_base::diag::{Code, Diagnostic, Severity, counted};
use nbc_base::model::Evolution;

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

/// What `--quick` makes of a declaration.
pub(in crate::cli) struct QuickRun<'a> {
    pub(in crate::cli) declared: &'a Evolution,
    pub(in crate::cli) used: &'a Evolution,
    /// The declarations that are not run.
    pub(in crate::cli) left_out: &'a [Evolution],
}

impl QuickRun<'_> {
    /// A line on what is different, and one on what is left out.
    pub(in crate::cli) fn text(&self) -> String {
        let Self { declared, used, left_out } = self;
        let (seeds, generations) = (used.seeds.len(), used.generations);
        let (all_seeds, all_generations) = (declared.seeds.len(), declared.generations);
        let name = &declared.name;
        let mut text = format!(
            "`--quick` runs `{name}` with {} of {all_seeds} and {} instead of {all_generations}\n",
            counted(seeds, "seed"),
            counted(generations as usize, "generation")
        );
        if !left_out.is_empty() {
            let names: Vec<&str> = left_out.iter().map(|evolution| evolution.name.as_str()).collect();
            text += &format!("`--quick` leaves out {}\n", alternatives(&names, "and"));
        }
        text
    }
}

/// A run that is resumed until another generation than before.
pub(in crate::cli) struct ResumedUntil {
    pub(in crate::cli) folder: String,
    pub(in crate::cli) done: u32,
    pub(in crate::cli) before: u32,
    pub(in crate::cli) now: u32,
}

impl ResumedUntil {
    /// A line on what is different; empty if nothing is.
    pub(in crate::cli) fn text(&self) -> String {
        let Self { folder, done, before, now } = self;
        let made = counted(*done as usize, "generation");
        if done > now {
            return format!("`{folder}` has {made} already, more than the {now} that are asked for\n");
        }
        if before == now {
            return String::new();
        }
        format!("`{folder}`, which was to have {before}, continues after {made} until it has {now}\n")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_resumed_run_says_what_is_replaced() {
        let text = |done, before, now| ResumedUntil { folder: "out/a/seed-1".to_owned(), done, before, now }.text();
        let longer = "`out/a/seed-1`, which was to have 10, continues after 10 generations until it has 50\n";
        assert_eq!(text(10, 10, 50), longer);
        let fewer = "`out/a/seed-1` has 10 generations already, more than the 5 that are asked for\n";
        assert_eq!(text(10, 10, 5), fewer);
        assert_eq!(text(4, 10, 10), "");
    }
}
