//! Writing files whole or not at all.

use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::draft::{DraftFile, keep_owner_and_mode};
use nbc_base::diag::Diagnostic;

/// Its path has at any time either the old contents or all of `bytes`, which are flushed to the disk first.
pub fn write(path: &Path, bytes: &[u8]) -> io::Result<()> {
    write_with(path, |out| out.write_all(bytes))
}

pub fn write_file(path: &Path, bytes: &[u8]) -> Result<(), Diagnostic> {
    write(path, bytes).map_err(|error| Diagnostic::unwritable(path, &error))
}

pub fn write_with(path: &Path, content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    // The target of a link is replaced, not the link; a device such as /dev/null is written directly.
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    match fs::metadata(&target) {
        Ok(about) if about.is_dir() => Err(io::Error::other("it is a folder")),
        Ok(about) if !about.is_file() => content(&mut fs::OpenOptions::new().write(true).open(&target)?),
        _ => replace(&target, content),
    }
}

/// Writes a new file and gives it a name, whatever has that name.
pub(super) fn replace(target: &Path, content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let folder = match target.parent() {
        Some(folder) if folder != Path::new("") => folder.to_owned(),
        _ => PathBuf::from("."),
    };
    let before = fs::symlink_metadata(target).ok().filter(fs::Metadata::is_file);
    if before.as_ref().is_some_and(|before| before.permissions().readonly()) {
        return Err(io::Error::other("it is read-only"));
    }
    let mut draft = DraftFile::create(&folder)?;
    let mut buffer = BufWriter::new(draft.file());
    content(&mut buffer)?;
    buffer.flush()?;
    drop(buffer);
    if let Some(before) = before {
        keep_owner_and_mode(draft.file(), &before)?;
    }
    draft.file().sync_all()?;
    draft.persist(&folder, target)?;
    // Windows opens no folder as a file, and keeps names without that.
    if cfg!(windows) { Ok(()) } else { fs::File::open(&folder)?.sync_all() }
}

pub fn create_folder(path: &Path) -> io::Result<()> {
    fs::create_dir_all(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_replaced_and_no_other_file_is_left() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("result.json");
        write(&path, b"old").unwrap();
        write(&path, b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    #[cfg(unix)]
    fn a_file_keeps_its_mode_and_its_owner_and_a_read_only_one_stays() {
        use std::os::unix::fs::{MetadataExt, PermissionsExt};
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.nb");
        fs::write(&path, "old").unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
        // Only the superuser may change the owner of a file.
        let _ = std::os::unix::fs::chown(&path, Some(12_345), Some(54_321));
        let about = |path: &Path| fs::metadata(path).map(|about| (about.mode(), about.uid(), about.gid())).unwrap();
        let before = about(&path);
        write(&path, b"new").unwrap();
        assert_eq!(about(&path), before);
        fs::set_permissions(&path, fs::Permissions::from_mode(0o440)).unwrap();
        assert_eq!(write(&path, b"newer").unwrap_err().to_string(), "it is read-only");
        assert_eq!(fs::read(&path).unwrap(), b"new");
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn a_file_gets_its_name_when_it_is_complete() {
        let folder = tempfile::tempdir().unwrap();
        for path in ["new.gif", "new.gif"].map(|name| folder.path().join(name)) {
            let before = fs::read_dir(folder.path()).unwrap().count();
            write_with(&path, |out| {
                out.write_all(&[0; 100_000])?;
                // A program that ended here would leave no file behind.
                assert_eq!(fs::read_dir(folder.path()).unwrap().count(), before);
                Ok(())
            })
            .unwrap();
        }
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_missing_folder_is_an_error_and_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        assert!(write(&folder.path().join("none/result.json"), b"new").is_err());
        assert!(write(folder.path(), b"new").is_err());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    #[test]
    fn failing_content_leaves_the_old_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("film.gif");
        write(&path, b"old").unwrap();
        let broken = write_with(&path, |out| {
            out.write_all(b"half")?;
            Err(io::Error::other("no more"))
        });
        assert_eq!(broken.unwrap_err().to_string(), "no more");
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_device_stays_a_device() {
        write(Path::new("/dev/null"), b"gone").unwrap();
        assert!(!fs::metadata("/dev/null").unwrap().is_file());
    }
}
