//! Reading regular files up to a limit of size.

use std::fs::{self, File, FileType};
use std::io::{self, Read};
use std::path::Path;

use nbc_base::budget::Limit;
use nbc_base::diag::io_words;
use nbc_base::source::{EntryKind, FileError};

/// The path of standard input, which may be a pipe. Windows has no such path.
const STANDARD_INPUT: &str = "/dev/stdin";

/// Folders, pipes and devices are rejected unopened: a pipe waits for its writer. Standard input is read in any case.
pub fn read(path: &Path, limit: u64) -> Result<Vec<u8>, FileError> {
    if cfg!(windows) && path == Path::new(STANDARD_INPUT) {
        return up_to(limit, io::stdin().lock());
    }
    let about = fs::metadata(path).map_err(|error| refusal(&error))?;
    if !about.is_file() && path != Path::new(STANDARD_INPUT) {
        return Err(FileError::NotRegular(kind(about.file_type())));
    }
    if about.len() > limit {
        return Err(FileError::TooLarge { limit });
    }
    // The system does not know the size of every file.
    up_to(limit, File::open(path).map_err(|error| refusal(&error))?)
}

/// All bytes, if there are no more than the limit; one byte more shows that there are.
fn up_to(limit: u64, file: impl Read) -> Result<Vec<u8>, FileError> {
    let mut bytes = Vec::new();
    file.take(limit + 1).read_to_end(&mut bytes).map_err(|error| refusal(&error))?;
    if bytes.len() as u64 > limit { Err(FileError::TooLarge { limit }) } else { Ok(bytes) }
}

pub fn read_text(path: &Path, limit: u64) -> Result<String, FileError> {
    let bytes = read(path, limit)?;
    FileError::text(bytes)
}

pub(super) fn refusal(error: &std::io::Error) -> FileError {
    match error.kind() {
        std::io::ErrorKind::NotFound => FileError::NotFound,
        _ => FileError::Io(io_words(error)),
    }
}

fn kind(of: FileType) -> &'static str {
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        if of.is_fifo() {
            return "a pipe";
        }
        if of.is_char_device() || of.is_block_device() {
            return "a device";
        }
        if of.is_socket() {
            return "a socket";
        }
    }
    if of.is_dir() { "a folder" } else { "a special file" }
}

pub(super) fn source(path: &Path) -> Result<String, FileError> {
    read_text(path, Limit::SourceBytes.most())
}

pub(super) fn source_bytes(path: &Path) -> Result<Vec<u8>, FileError> {
    read(path, Limit::SourceBytes.most())
}

pub(super) fn list(folder: &Path) -> Result<Vec<String>, FileError> {
    if folder.is_file() {
        return Err(FileError::Io("it is not a folder".to_owned()));
    }
    let entries = fs::read_dir(folder).and_then(|entries| entries.collect::<Result<Vec<_>, _>>());
    let entries = entries.map_err(|error| refusal(&error))?;
    let mut names: Vec<_> = entries.iter().map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    Ok(names)
}

pub(super) fn entry_kind(path: &Path) -> Option<EntryKind> {
    let about = fs::metadata(path).ok()?;
    Some(if about.is_dir() { EntryKind::Folder } else { EntryKind::File })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(bytes: &[u8], expected: Result<&str, FileError>) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.nb");
        fs::write(&path, bytes).unwrap();
        assert_eq!(read_text(&path, 10), expected.map(str::to_owned));
    }

    #[test]
    fn text_is_read_and_invalid_utf8_is_rejected() {
        check("circuit é".as_bytes(), Ok("circuit é"));
        check(b"circuit \xff", Err(FileError::NotText { offset: 8 }));
    }

    #[test]
    fn a_file_above_the_limit_is_rejected() {
        check(b"ten bytes.", Ok("ten bytes."));
        check(b"eleven byte", Err(FileError::TooLarge { limit: 10 }));
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn a_file_whose_size_the_system_does_not_know_is_read_up_to_the_limit() {
        assert_eq!(fs::metadata("/proc/cpuinfo").unwrap().len(), 0);
        assert_eq!(read(Path::new("/proc/cpuinfo"), 10), Err(FileError::TooLarge { limit: 10 }));
    }

    #[test]
    fn missing_files_and_folders_are_distinguished() {
        assert_eq!(source(Path::new("no/such/file")), Err(FileError::NotFound));
        assert_eq!(source(Path::new("/")), Err(FileError::NotRegular("a folder")));
    }

    #[test]
    #[cfg(unix)]
    fn pipes_and_devices_are_not_opened() {
        let folder = tempfile::tempdir().unwrap();
        let pipe = folder.path().join("pipe.nb");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        assert_eq!(read(&pipe, 10), Err(FileError::NotRegular("a pipe")));
        assert_eq!(source(Path::new("/dev/zero")), Err(FileError::NotRegular("a device")));
    }
}
