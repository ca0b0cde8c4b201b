//! Messages of evolution runs and their folders.

use std::path::Path;

use nbc_base::diag::suggest::alternatives;
use nbc_base::diag::{Code, Diagnostic, Severity, counted};
use nbc_base::model::Evolution;

use crate::cli::wording::no_such;

pub(super) fn no_evolution(file: &Path, known: &[String]) -> Diagnostic {
    Diagnostic::without_place(Code::Unknown, format!("`{}` declares no evolution", file.display()))
        .with_help(format!("run one that it uses with `--run`: {}", alternatives(known, "or")))
}

pub(super) fn unknown_evolution(name: &str, known: &[String]) -> Diagnostic {
    no_such(format!("no evolution is called `{name}`"), name, known)
}

pub(super) fn held_folder(folder: &Path, process: Option<u32>) -> Diagnostic {
    let who = process.map_or_else(|| "another process".to_owned(), |process| format!("process {process}"));
    Diagnostic::without_place(Code::Unwritable, format!("`{}` is in use by {who}", folder.display()))
        .with_help("wait until it has ended, or choose another folder with `--out`")
}

pub(super) fn has_run(folder: &Path) -> Diagnostic {
    Diagnostic::without_place(Code::Checkpoint, format!("`{}` already contains a run", folder.display()))
        .with_help("continue it with `--resume`, or choose another folder with `--out`")
}

pub(super) fn no_robot_found() -> Diagnostic {
    Diagnostic::without_place(Code::Empty, "no run found a robot")
        .with_help("the summary tells what became of the bodies; more generations or a larger box may help")
}

pub(in crate::cli) fn no_checkpoint(path: &Path) -> Diagnostic {
    Diagnostic::without_place(Code::Checkpoint, format!("there is no checkpoint `{}`", path.display()))
        .with_help("name the folder of a run such as `out/gates`, or of one of its seeds such as `out/gates/seed-1`")
}

fn progress_gaps(path: &Path, damage: &str, help: impl Into<String>) -> Diagnostic {
    let fault = Diagnostic::without_place(Code::Checkpoint, format!("`{}` {damage}", path.display()));
    Diagnostic { severity: Severity::Warning, ..fault }.with_help(help)
}

/// Warns that lines of past generations are missing; curves are drawn without them.
pub(in crate::cli) fn gaps_in_curves(path: &Path, damage: &str) -> Diagnostic {
    progress_gaps(path, damage, "curves over time leave them out")
}

/// Warns that lines of past generations are missing; the run goes on without them. `kept` is the damaged file.
pub(super) fn gaps_in_run(path: &Path, damage: &str, kept: Option<&Path>) -> Diagnostic {
    let kept = kept.map_or_else(String::new, |kept| format!("; the damaged file is kept as `{}`", kept.display()));
    progress_gaps(path, damage, format!("the run continues without them{kept}"))
}

/// What `--quick` changes and leaves out.
pub(super) fn quick_run(declared: &Evolution, used: &Evolution, left_out: &[Evolution]) -> String {
    let mut text = format!(
        "`--quick` runs `{}` with {} of {} and {} instead of {}\n",
        declared.name,
        counted(used.seeds.len(), "seed"),
        declared.seeds.len(),
        counted(used.generations as usize, "generation"),
        declared.generations
    );
    if !left_out.is_empty() {
        let names: Vec<&str> = left_out.iter().map(|evolution| evolution.name.as_str()).collect();
        text += &format!("`--quick` leaves out {}\n", alternatives(&names, "and"));
    }
    text
}

/// A run that is resumed until generation `now`, and `before` was to end elsewhere; empty if nothing changes.
pub(super) fn resumed_until(folder: &Path, done: u32, before: u32, now: u32) -> String {
    let (folder, made) = (folder.display(), counted(done as usize, "generation"));
    if done > now {
        return format!("`{folder}` has {made} already, more than the {now} that are asked for\n");
    }
    if before == now {
        return String::new();
    }
    format!("`{folder}`, which was to have {before}, continues after {made} until it has {now}\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_resumed_run_says_what_is_replaced() {
        let text = |done, before, now| resumed_until(Path::new("out/a/seed-1"), done, before, now);
        let longer = "`out/a/seed-1`, which was to have 10, continues after 10 generations until it has 50\n";
        assert_eq!(text(10, 10, 50), longer);
        let fewer = "`out/a/seed-1` has 10 generations already, more than the 5 that are asked for\n";
        assert_eq!(text(10, 10, 5), fewer);
        assert_eq!(text(4, 10, 10), "");
    }
}
