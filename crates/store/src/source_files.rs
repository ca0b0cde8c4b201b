//! The source files below folders.

use std::fs;
use std::path::{Path, PathBuf};

const MOST: usize = 10_000;

/// The wanted source files in and below folders, in order, without hidden folders and those of results and packages.
pub fn source_files(folders: impl IntoIterator<Item = PathBuf>, wanted: impl Fn(&str) -> bool) -> Vec<String> {
    let mut found = Vec::new();
    let mut open: Vec<PathBuf> = folders.into_iter().collect();
    let mut seen = 0;
    while let Some(folder) = open.pop() {
        for entry in fs::read_dir(&folder).into_iter().flatten().flatten() {
            seen += 1;
            let (path, kind) = (entry.path(), entry.file_type());
            match kind {
                _ if seen > MOST => break,
                Ok(kind) if kind.is_dir() && !is_left_out(&path) => open.push(path),
                Ok(kind) if kind.is_file() => {
                    let path = path.to_string_lossy().into_owned();
                    found.extend(Some(path).filter(|path| wanted(path)));
                }
                _ => {}
            }
        }
    }
    found.sort();
    found.dedup();
    found
}

fn is_left_out(folder: &Path) -> bool {
    let name = folder.file_name().unwrap_or_default().to_string_lossy();
    name.starts_with('.') || ["node_modules", "out", "target"].contains(&name.as_ref())
}
