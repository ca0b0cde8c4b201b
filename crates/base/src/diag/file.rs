//! Diagnostics for files that cannot be read or written.

use std::io;
use std::path::Path;

use super::suggest::nearest;
use super::{Code, Diagnostic, Suggestion};
use crate::source::{FileError, SourceWorld};

impl Diagnostic {
    pub fn unreadable(path: &str, error: &FileError) -> Self {
        let why = file_error(error);
        Self::without_place(Code::Unreadable, format!("cannot read `{path}`: {why}"))
    }

    /// As [`Diagnostic::unreadable`]; if there is no such file, with the file of the folder that may have been meant.
    pub fn unreadable_in(world: &dyn SourceWorld, path: &str, error: &FileError) -> Self {
        let meant = if *error == FileError::NotFound { similar_file(world, path) } else { Suggestion::None };
        Self::unreadable(path, error).with_suggestion(None, &meant)
    }

    pub fn unwritable(path: &Path, error: &io::Error) -> Self {
        Self::without_place(Code::Unwritable, format!("cannot write `{}`: {}", path.display(), io_words(error)))
    }
}

/// The file that may have been meant by a path without a file: one in the same folder with the same extension.
pub fn similar_file(world: &dyn SourceWorld, path: &str) -> Suggestion {
    let (folder, name) = path.rsplit_once('/').map_or(("", path), |(folder, name)| (&path[..=folder.len()], name));
    let (stem, ending) = name.rsplit_once('.').unwrap_or((name, "nb"));
    let listed = match folder {
        "" => ".",
        "/" => "/",
        _ => folder.trim_end_matches('/'),
    };
    let Ok(names) = world.list(listed) else { return Suggestion::None };
    let stems = names.iter().filter_map(|name| name.rsplit_once('.')).filter(|(_, known)| *known == ending);
    match nearest(stem, stems.map(|(stem, _)| stem)) {
        Some(near) => Suggestion::Near(format!("{folder}{near}.{ending}")),
        None => Suggestion::None,
    }
}

pub(super) fn file_error(error: &FileError) -> String {
    match error {
        FileError::NotFound => "there is no such file".to_owned(),
        FileError::NotRegular(kind) => format!("expected a regular file, found {kind}"),
        FileError::TooLarge { limit } => format!("file is larger than the limit of {}", size(*limit)),
        FileError::NotText { offset } => format!("file is not valid UTF-8 (byte {offset})"),
        FileError::Io(words) => words.clone(),
    }
}

pub fn folder_error(error: &FileError) -> &str {
    match error {
        FileError::NotFound => "there is no such folder",
        FileError::Io(words) => words,
        FileError::NotRegular(_) | FileError::TooLarge { .. } | FileError::NotText { .. } => "it is not a folder",
    }
}

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
    fn a_missing_file_is_compared_with_those_of_its_folder_and_kind() {
        let mut world = crate::source::MemoryWorld::default();
        for path in ["a/latch.nb", "a/latch.md", "a/lach.yaml"] {
            world.insert(path, "");
        }
        let near = |path: &str| Suggestion::Near(path.to_owned());
        assert_eq!(similar_file(&world, "a/lach.nb"), near("a/latch.nb"));
        assert_eq!(similar_file(&world, "a/latch"), near("a/latch.nb"));
        assert_eq!(similar_file(&world, "a/counter.nb"), Suggestion::None);
        assert_eq!(similar_file(&world, "b/latch.nb"), Suggestion::None);
        let told = Diagnostic::unreadable_in(&world, "a/lach.nb", &FileError::NotFound);
        assert_eq!(told.help.as_deref(), Some("did you mean `a/latch.nb`?"));
        assert_eq!(Diagnostic::unreadable_in(&world, "a/lach.nb", &FileError::NotRegular("a pipe")).help, None);
    }

    #[test]
    fn sizes_are_shown_in_the_largest_unit() {
        assert_eq!([8 << 20, 1 << 30, 1000, 3 << 10].map(size), ["8 MB", "1 GB", "1000 bytes", "3 kB"]);
    }
}
