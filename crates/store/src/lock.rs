//! Folders that one process writes at a time.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Read, Write};
use std::path::Path;

use crate::results::is_link;

/// Contains the number of the process; never removed, since the system releases the lock when the process ends.
const NAME: &str = "lock";

/// A folder that no other process writes to until this is dropped.
#[derive(Debug)]
pub struct FolderLock(#[expect(dead_code, reason = "the lock lasts as long as the file is open")] File);

#[derive(Debug)]
pub enum LockFault {
    Held {
        /// Its number, if already written.
        process: Option<u32>,
    },
    Io(io::Error),
}

pub fn lock_folder(folder: &Path) -> Result<FolderLock, LockFault> {
    let path = folder.join(NAME);
    if is_link(&path) {
        return Err(LockFault::Io(io::Error::other("it is a link")));
    }
    let mut file = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path)?;
    match file.try_lock() {
        Ok(()) => {}
        Err(TryLockError::WouldBlock) => return Err(LockFault::Held { process: holder(&mut file) }),
        Err(TryLockError::Error(error)) => return Err(LockFault::Io(error)),
    }
    file.set_len(0)?;
    writeln!(file, "{}", std::process::id())?;
    Ok(FolderLock(file))
}

fn holder(file: &mut File) -> Option<u32> {
    let mut text = String::new();
    // Far longer than a number; a longer file was not written by `nbc`.
    file.take(64).read_to_string(&mut text).ok()?;
    text.trim().parse().ok()
}

impl From<io::Error> for LockFault {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_is_locked_by_one_process_and_released_after() {
        let folder = tempfile::tempdir().unwrap();
        let held = lock_folder(folder.path()).unwrap();
        let Err(LockFault::Held { process }) = lock_folder(folder.path()) else { panic!("it is held") };
        assert_eq!(process, Some(std::process::id()));
        drop(held);
        std::fs::write(folder.path().join(NAME), "a longer text that an earlier process left").unwrap();
        let _held = lock_folder(folder.path()).unwrap();
        let said = std::fs::read_to_string(folder.path().join(NAME)).unwrap();
        assert_eq!(said, format!("{}\n", std::process::id()));
    }

    #[test]
    #[cfg(unix)]
    fn the_lock_does_not_follow_a_link() {
        let folder = tempfile::tempdir().unwrap();
        let other = folder.path().join("other");
        std::fs::write(&other, "mine").unwrap();
        std::os::unix::fs::symlink(&other, folder.path().join(NAME)).unwrap();
        assert!(matches!(lock_folder(folder.path()), Err(LockFault::Io(_))));
        assert_eq!(std::fs::read_to_string(other).unwrap(), "mine");
    }

    #[test]
    fn locking_a_missing_folder_is_an_error() {
        assert!(matches!(lock_folder(Path::new("/no/such/folder")), Err(LockFault::Io(_))));
    }
}
