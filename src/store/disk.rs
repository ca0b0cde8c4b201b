//! The disk as the world that source files come from.

use std::fs::{self, File};
use std::io::{ErrorKind, Read};

use crate::source::{FileError, World};

/// The largest source file read, in bytes.
const LIMIT: u64 = 64 << 20;

/// The files of this computer.
#[derive(Clone, Copy, Debug, Default)]
pub struct DiskWorld;

impl World for DiskWorld {
    fn read(&self, path: &str) -> Result<String, FileError> {
        let bytes = read_bytes(path)?;
        String::from_utf8(bytes).map_err(|error| FileError::NotText { offset: error.utf8_error().valid_up_to() })
    }
}

fn read_bytes(path: &str) -> Result<Vec<u8>, FileError> {
    if fs::metadata(path).map_err(refusal)?.is_dir() {
        return Err(FileError::Io("it is a folder".to_owned()));
    }
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(refusal)?;
    // One byte more than allowed tells a file that is too large, even one whose size the system does not know.
    file.take(LIMIT + 1).read_to_end(&mut bytes).map_err(refusal)?;
    if bytes.len() as u64 > LIMIT {
        let bytes = fs::metadata(path).map_or(LIMIT + 1, |about| about.len().max(LIMIT + 1));
        return Err(FileError::TooLarge { bytes, limit: LIMIT });
    }
    Ok(bytes)
}

fn refusal(error: std::io::Error) -> FileError {
    match error.kind() {
        ErrorKind::NotFound => FileError::NotFound,
        ErrorKind::PermissionDenied => FileError::Io("permission denied".to_owned()),
        _ => FileError::Io(error.to_string().to_lowercase()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(bytes: &[u8], expected: Result<&str, FileError>) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.nb");
        fs::write(&path, bytes).unwrap();
        assert_eq!(DiskWorld.read(path.to_str().unwrap()), expected.map(str::to_owned));
    }

    #[test]
    fn text_is_read_and_bytes_are_refused() {
        check("circuit é".as_bytes(), Ok("circuit é"));
        check(b"circuit \xff", Err(FileError::NotText { offset: 8 }));
    }

    #[test]
    fn missing_files_and_folders_are_told_apart() {
        assert_eq!(DiskWorld.read("no/such/file"), Err(FileError::NotFound));
        assert_eq!(DiskWorld.read("/"), Err(FileError::Io("it is a folder".to_owned())));
    }

    #[test]
    fn a_file_without_end_is_too_large() {
        let expected = FileError::TooLarge { bytes: LIMIT + 1, limit: LIMIT };
        assert_eq!(DiskWorld.read("/dev/zero"), Err(expected));
    }
}
