//! The folder of an evolution run: its checkpoint and its progress.

use std::fs;
use std::path::{Path, PathBuf};

use crate::cli::Failure;
use nbc_base::budget::Limit;
use nbc_base::diag::Diagnostic;
use nbc_base::source::FileError;
use nbc_session::store::{self, Checkpoint};

pub(super) const CHECKPOINT: &str = "checkpoint.nbc";
pub(super) const PROGRESS: &str = "progress.jsonl";

/// Of one seed, or of all seeds in their order.
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

pub(super) fn read_checkpoint(path: &Path) -> Result<Option<Checkpoint>, Failure> {
    Ok(Checkpoint::open(path)?)
}

/// Empty if there is no file.
pub(super) fn read_progress(path: &Path) -> Result<Vec<u8>, Failure> {
    match store::read(path, Limit::ProgressBytes.most()) {
        Ok(bytes) => Ok(bytes),
        Err(FileError::NotFound) => Ok(Vec::new()),
        Err(error) => Err(Diagnostic::unreadable(&path.display().to_string(), &error).into()),
    }
}
