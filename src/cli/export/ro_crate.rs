//! A folder of evolution runs as an RO-Crate.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

use nbc_session::report::{CrateFile, CrateRun, ro_crate};
use sha2::{Digest, Sha256};

use crate::cli::evolution_folder::{CHECKPOINT, PROGRESS, checkpoints, read_checkpoint};
use crate::cli::source_path::source_path;
use crate::cli::{Failure, Progress};

/// How deep below the named folder runs are looked for.
const DEPTH: usize = 4;

/// The files of a run: name, content and media type.
const FILES: [(&str, &str, &str); 2] = [
    (CHECKPOINT, "The archive, with all that is needed to go on", "application/octet-stream"),
    (PROGRESS, "A line for each generation", "application/jsonl"),
];

/// The metadata of the runs below a folder; `None` if there are none.
pub(super) fn describe(folder: &Path, license: Option<&str>) -> Result<Option<String>, Failure> {
    let found = runs_below(folder, DEPTH);
    let progress = Progress::new("runs", found.len() as u64);
    let mut runs = Vec::new();
    for path in found {
        runs.extend(run(folder, &path)?);
        progress.add(1);
    }
    if runs.is_empty() {
        return Ok(None);
    }
    let title = folder.canonicalize().ok().and_then(|whole| Some(whole.file_name()?.to_string_lossy().into_owned()));
    let metadata = ro_crate(&title.unwrap_or_else(|| "runs".to_owned()), license, &runs);
    Ok(Some(serde_json::to_string_pretty(&metadata).expect("metadata can be written as JSON") + "\n"))
}

/// The checkpoints in a folder and below it.
fn runs_below(folder: &Path, depth: usize) -> Vec<PathBuf> {
    let here = checkpoints(folder);
    if !here.is_empty() || depth == 0 {
        return here;
    }
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let mut folders: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    folders.retain(|path| path.is_dir() && !path.is_symlink());
    folders.sort();
    folders.iter().flat_map(|folder| runs_below(folder, depth - 1)).collect()
}

/// One run with its files.
fn run(root: &Path, checkpoint: &Path) -> Result<Option<CrateRun>, Failure> {
    let Some(known) = read_checkpoint(checkpoint)? else { return Ok(None) };
    let parts = checkpoint.parent().and_then(|folder| folder.strip_prefix(root).ok()).unwrap_or(Path::new(""));
    let folder = parts.iter().map(|part| source_path(Path::new(part))).collect::<Result<Vec<_>, _>>()?.join("/");
    let mut files = Vec::new();
    for (name, description, media) in FILES {
        let path = checkpoint.with_file_name(name);
        if !path.exists() {
            continue;
        }
        let (size, sha256) = digest(&path).map_err(|error| Failure::unreadable(&path, &error))?;
        let path = if folder.is_empty() { name.to_owned() } else { format!("{folder}/{name}") };
        files.push(CrateFile { path, description, media, size, sha256 });
    }
    let changed = fs::metadata(checkpoint).and_then(|known| known.modified());
    let changed = changed.map_err(|error| Failure::unreadable(checkpoint, &error))?;
    Ok(Some(CrateRun {
        folder,
        evolution: known.declared.name,
        seed: known.state.seed,
        generations: known.state.generation,
        version: known.version,
        ended: moment(changed),
        files,
    }))
}

/// The size and the SHA-256 of a file.
fn digest(path: &Path) -> std::io::Result<(u64, String)> {
    let mut hasher = Sha256::new();
    let size = std::io::copy(&mut fs::File::open(path)?, &mut hasher)?;
    Ok((size, hasher.finalize().iter().map(|byte| format!("{byte:02x}")).collect()))
}

/// A time in the form of ISO 8601, in UTC.
fn moment(time: SystemTime) -> String {
    let seconds = time.duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
    let (year, month, day) = date(seconds / 86_400);
    let (hour, minute, second) = (seconds / 3600 % 24, seconds / 60 % 60, seconds % 60);
    format!("{year}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}+00:00")
}

/// The date of a day, counted from 1970-01-01, by the calendar of 400 years that begin in March.
fn date(days: u64) -> (u64, u64, u64) {
    // From the first of March of the year 0.
    let days = days + 719_468;
    let (era, in_era) = (days / 146_097, days % 146_097);
    let year = (in_era - in_era / 1460 + in_era / 36_524 - in_era / 146_096) / 365;
    let in_year = in_era - (365 * year + year / 4 - year / 100);
    let from_march = (5 * in_year + 2) / 153;
    let day = in_year - (153 * from_march + 2) / 5 + 1;
    let month = if from_march < 10 { from_march + 3 } else { from_march - 9 };
    (era * 400 + year + u64::from(month <= 2), month, day)
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    #[test]
    fn times_are_written_by_the_calendar() {
        let at = |seconds| moment(UNIX_EPOCH + Duration::from_secs(seconds));
        assert_eq!(at(0), "1970-01-01T00:00:00+00:00");
        assert_eq!(at(951_782_400), "2000-02-29T00:00:00+00:00");
        assert_eq!(at(1_735_689_599), "2024-12-31T23:59:59+00:00");
        assert_eq!(at(1_772_323_200), "2026-03-01T00:00:00+00:00");
    }
}
