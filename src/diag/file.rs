//! Diagnostics for files that cannot be read or written.

use std::io;
use std::path::Path;

use super::{Code, Diagnostic};
use crate::source::FileError;

impl Diagnostic {
    /// The error of reading the file at `path`, as the user wrote it.
    pub fn unreadable(path: &str, error: &FileError) -> Self {
        let why = file_error(error);
        Self::without_place(Code::Unreadable, format!("cannot read `{path}`: {why}"))
    }

    /// The error of writing a file or folder.
    pub fn unwritable(path: &Path, error: &io::Error) -> Self {
        Self::without_place(Code::Unwritable, format!("cannot write `{}`: {}", path.display(), io_words(error)))
    }
}

/// Why a file cannot be read, in plain words.
fn file_error(error: &FileError) -> String {
    match error {
        FileError::NotFound => "there is no such file".to_owned(),
        FileError::NotRegular(kind) => format!("expected a regular file, found {kind}"),
        FileError::TooLarge { limit } => format!("file is larger than the limit of {}", size(*limit)),
        FileError::NotText { offset } => format!("file is not valid UTF-8 (byte {offset})"),
        FileError::Io(words) => words.clone(),
    }
}

/// Why a folder cannot be listed, in plain words.
pub fn folder_error(error: &FileError) -> &str {
    match error {
        FileError::NotFound => "there is no such folder",
        FileError::Io(words) => words,
        FileError::NotRegular(_) | FileError::TooLarge { .. } | FileError::NotText { .. } => "it is not a folder",
    }
}

/// The operating system's message in plain words, without error numbers.
pub fn io_words(error: &io::Error) -> String {
    use io::ErrorKind;
    let plain = match error.kind() {
        ErrorKind::NotFound => "there is no such file or folder",
        ErrorKind::PermissionDenied => "permission denied",
        ErrorKind::AlreadyExists => "it already exists",
        ErrorKind::IsADirectory => "it is a folder",
        ErrorKind::NotADirectory => "part of the path is not a folder",
        ErrorKind::StorageFull => "the disk is full",
        ErrorKind::ReadOnlyFilesystem => "the file system is read-only",
        ErrorKind::InvalidFilename => "the name is too long or not allowed",
        ErrorKind::FileTooLarge => "the file would be too large",
        _ => "",
    };
    if !plain.is_empty() {
        return plain.to_owned();
    }
    let words = error.to_string().to_lowercase();
    words.split(" (os error").next().unwrap_or_default().to_owned()
}

/// A size in the largest unit that divides it.
fn size(bytes: u64) -> String {
    let units = [(30, "GB"), (20, "MB"), (10, "kB")];
    let fitting = units.into_iter().find(|(shift, _)| bytes >= 1 << shift && bytes.trailing_zeros() >= *shift);
    fitting.map_or_else(|| format!("{bytes} bytes"), |(shift, unit)| format!("{} {unit}", bytes >> shift))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn system_errors_are_worded_plainly() {
        let words = |number| io_words(&io::Error::from_raw_os_error(number));
        assert_eq!(io_words(&io::Error::from(io::ErrorKind::NotFound)), "there is no such file or folder");
        assert!(!words(5).contains("os error"), "{}", words(5));
        assert_eq!(io_words(&io::Error::other("No More")), "no more");
    }

    #[test]
    fn sizes_are_shown_in_the_largest_unit() {
        assert_eq!([8 << 20, 1 << 30, 1000, 3 << 10].map(size), ["8 MB", "1 GB", "1000 bytes", "3 kB"]);
    }
}
