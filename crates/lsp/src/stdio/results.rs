//! The folder with the results of a server's commands. It is removed when the server ends, or by a later server.

use std::fs::{self, DirEntry};
use std::io;
use std::path::PathBuf;

use nbc_session::store::{self, FolderLock, lock_folder};

/// The folder is made for the first result.
#[derive(Default)]
pub(super) struct ResultFolder {
    made: Option<(PathBuf, FolderLock)>,
}

/// Followed by the process id.
const PREFIX: &str = "results-";

/// A server that starts may remove the folder before it is locked.
const TRIES: usize = 3;

impl ResultFolder {
    pub(super) fn path(&mut self) -> Result<PathBuf, String> {
        if let Some((path, _)) = &self.made {
            return Ok(path.clone());
        }
        let all = store::temporary_folder().map_err(|error| format!("cannot make a temporary folder: {error}"))?;
        let path = all.join(format!("{PREFIX}{}", std::process::id()));
        let made = (0..TRIES).find_map(|_| {
            store::create_folder(&path).ok()?;
            lock_folder(&path).ok()
        });
        let lock = made.ok_or_else(|| format!("cannot write to `{}`", path.display()))?;
        self.made = Some((path.clone(), lock));
        Ok(path)
    }
}

impl Drop for ResultFolder {
    fn drop(&mut self) {
        let Some((path, lock)) = self.made.take() else { return };
        drop(lock);
        // What is left, the next server removes.
        let _ = fs::remove_dir_all(path);
    }
}

/// Nobody holds the lock of a server that has ended.
pub(super) fn remove_leftovers() {
    for entry in store::temporary_folder().and_then(fs::read_dir).into_iter().flatten().flatten().filter(is_results) {
        let _ = remove_unlocked(&entry);
    }
}

fn is_results(entry: &DirEntry) -> bool {
    let name = entry.file_name();
    let number = name.to_str().and_then(|name| name.strip_prefix(PREFIX)).unwrap_or_default();
    // A link is not followed.
    number.parse::<u32>().is_ok() && entry.file_type().is_ok_and(|kind| kind.is_dir())
}

fn remove_unlocked(entry: &DirEntry) -> io::Result<()> {
    // The folder of another user cannot be locked.
    match lock_folder(&entry.path()) {
        Ok(lock) => {
            drop(lock);
            fs::remove_dir_all(entry.path())
        }
        Err(_) => Ok(()),
    }
}
