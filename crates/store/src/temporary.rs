//! The folder for temporary files of this version of the program and this user of the machine.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use nbc_base::VERSION;
use tempfile::{Builder, TempPath};

/// Makes the folder if it is missing. Only its user can read it.
pub fn temporary_folder() -> io::Result<PathBuf> {
    of_user(&std::env::temp_dir())
}

/// A file that only its user can read. It is removed when this is dropped.
#[derive(Debug)]
pub struct PrivateFile(TempPath);

impl PrivateFile {
    /// A new file in the folder for temporary files; its name has this start and this end.
    pub fn create(start: &str, end: &str, text: &str) -> io::Result<Self> {
        // Files that this makes are readable by their user only.
        let mut file = Builder::new().prefix(start).suffix(end).tempfile_in(temporary_folder()?)?;
        file.write_all(text.as_bytes())?;
        Ok(Self(file.into_temp_path()))
    }

    pub fn path(&self) -> &Path {
        &self.0
    }
}

#[cfg(unix)]
fn of_user(all: &Path) -> io::Result<PathBuf> {
    use std::os::unix::fs::{DirBuilderExt, MetadataExt, PermissionsExt};
    // A file that this process makes belongs to its user.
    let user = tempfile::tempfile_in(all)?.metadata()?.uid();
    let folder = all.join(format!("nbc-{VERSION}-{user}"));
    match fs::DirBuilder::new().mode(0o700).create(&folder) {
        Err(error) if error.kind() != io::ErrorKind::AlreadyExists => return Err(error),
        _ => {}
    }
    let about = fs::symlink_metadata(&folder)?;
    if !about.is_dir() || about.uid() != user {
        return Err(io::Error::other("it belongs to another user"));
    }
    if about.mode() & 0o077 != 0 {
        fs::set_permissions(&folder, fs::Permissions::from_mode(0o700))?;
    }
    Ok(folder)
}

#[cfg(not(unix))]
fn of_user(all: &Path) -> io::Result<PathBuf> {
    // Each user has a folder of temporary files.
    let folder = all.join(format!("nbc-{VERSION}"));
    fs::create_dir_all(&folder)?;
    Ok(folder)
}

#[cfg(all(test, unix))]
mod tests {
    use std::os::unix::fs::{MetadataExt, PermissionsExt, chown, symlink};

    use super::*;

    #[test]
    fn the_folder_is_of_the_user_alone() {
        let all = tempfile::tempdir().unwrap();
        // What the first user of the machine left.
        fs::create_dir(all.path().join(format!("nbc-{VERSION}"))).unwrap();
        let folder = of_user(all.path()).unwrap();
        let about = fs::metadata(&folder).unwrap();
        assert_eq!(about.mode() & 0o777, 0o700);
        assert!(folder.to_string_lossy().ends_with(&format!("-{}", about.uid())));
        fs::set_permissions(&folder, fs::Permissions::from_mode(0o755)).unwrap();
        assert_eq!(of_user(all.path()).unwrap(), folder);
        assert_eq!(fs::metadata(&folder).unwrap().mode() & 0o777, 0o700);
        // Only the superuser may give a folder away.
        if chown(&folder, Some(about.uid() + 1), None).is_ok() {
            assert_eq!(of_user(all.path()).unwrap_err().to_string(), "it belongs to another user");
        }
        fs::remove_dir(&folder).unwrap();
        symlink(all.path(), &folder).unwrap();
        assert!(of_user(all.path()).is_err());
    }
}
