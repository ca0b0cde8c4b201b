//! The folder of an evolution run: its checkpoint and its progress.

use std::fs;
use std::path::{Path, PathBuf};

use crate::cli::Failure;
use nbc_base::budget::Limit;
use nbc_base::diag::Diagnostic;
use nbc_base::source::FileError;
use nbc_session::store::{self, Checkpoint};

/// The file in a run's folder that it is resumed from.
pub(super) const CHECKPOINT: &str = "checkpoint.nbc";
/// The file in a run's folder with a line for each generation.
pub(super) const PROGRESS: &str = "progress.jsonl";

/// The checkpoints of a run: that of one seed, or those of all seeds in their order.
pub(super) fn checkpoints(folder: &Path) -> Vec<PathBuf> {
    let own = folder.join(CHECKPOINT);
    if own.is_file() {
        return vec![own];
    }
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let number = |path: &Path| path.file_name()?.to_str()?.strip_prefix("seed-")?.parse::<u64>().ok();
    let mut seeds: Vec<(u64, PathBuf)> = entries
        .filter_map(|entry| {
            let path = entry.ok()?.path();
            Some((number(&path)?, path.join(CHECKPOINT)))
        })
        .filter(|(_, checkpoint)| checkpoint.is_file())
        .collect();
    seeds.sort();
    seeds.into_iter().map(|(_, checkpoint)| checkpoint).collect()
}

/// The checkpoint at a path, if there is one.
pub(super) fn read_checkpoint(path: &Path) -> Result<Option<Checkpoint>, Failure> {
    Checkpoint::open(path).map_err(Failure::plain)
}

/// The bytes of a file of progress; empty if there is no file.
pub(super) fn read_progress(path: &Path) -> Result<Vec<u8>, Failure> {
    match store::read(path, Limit::ProgressBytes.most()) {
        Ok(bytes) => Ok(bytes),
        Err(FileError::NotFound) => Ok(Vec::new()),
        Err(error) => Err(Failure::plain(Diagnostic::unreadable(&path.display().to_string(), &error))),
    }
}
