//! Checkpoints of runs and swarms.

use nbc_base::diag::{Code, Diagnostic, counted};
use nbc_base::model::{Behavior, BodyError};

const AFRESH: &str = "choose another name for the run, or start it again without `--resume`";

fn fault(file: &str, what: &str) -> Diagnostic {
    Diagnostic::without_place(Code::Checkpoint, format!("`{file}` {what}"))
}

pub(crate) fn not_a_checkpoint(file: &str) -> Diagnostic {
    fault(file, "is not a checkpoint of such a run")
}

pub(crate) fn other_swarm(file: &str) -> Diagnostic {
    fault(file, "belongs to another swarm or other rows").with_help("choose another folder, or remove the file")
}

pub(crate) fn checkpoint_format(file: &str, found: &str, expected: &str) -> Diagnostic {
    let message = format!("`{file}` is a checkpoint of format {found}, expected format {expected}");
    Diagnostic::without_place(Code::ForeignFormat, message).with_help("resume it with the version that wrote it")
}

pub(crate) fn damaged(file: &str) -> Diagnostic {
    fault(file, "is damaged: its checksum does not match").with_help("start the run again")
}

pub(crate) fn unreadable_state(file: &str, words: &str) -> Diagnostic {
    fault(file, &format!("cannot be read: {words}"))
}

pub(crate) fn other_seed(file: &str, found: u64, expected: u64) -> Diagnostic {
    fault(file, &format!("belongs to seed {found}, expected seed {expected}")).with_help(AFRESH)
}

pub(crate) fn changed(file: &str, evolution: &str) -> Diagnostic {
    fault(file, &format!("was made by a different declaration of `{evolution}`")).with_help(AFRESH)
}

pub(crate) fn other_evolution(file: &str, evolution: &str) -> Diagnostic {
    fault(file, &format!("does not belong to evolution `{evolution}`")).with_help(AFRESH)
}

pub(crate) fn axis_bins(bins: usize, most: usize) -> String {
    format!("an axis has {}, expected 1 to {most}", counted(bins, "bin"))
}

pub(crate) fn no_niche(bins: &[u16]) -> String {
    format!("the archive has no niche {bins:?}")
}

pub(crate) fn elite_stimuli(behavior: Behavior, stimuli: usize) -> String {
    format!("an elite has the behavior {behavior}, expected one of {stimuli} stimuli")
}

pub(crate) fn elite_body(error: &BodyError) -> String {
    format!("an elite has no valid body: {error}")
}
