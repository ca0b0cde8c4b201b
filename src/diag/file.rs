//! Files that cannot be read, as diagnostics.

use super::{Code, Diagnostic};
use crate::source::FileError;

impl Diagnostic {
    /// What is wrong with the file at `path`, as the user wrote it.
    pub fn unreadable(path: &str, error: &FileError) -> Self {
        let why = match error {
            FileError::NotFound => "there is no such file".to_owned(),
            FileError::TooLarge { bytes, limit } => {
                format!("it has {bytes} bytes, expected at most {limit}")
            }
            FileError::NotText { offset } => format!("it is no text: byte {offset} is not UTF-8"),
            FileError::Io(words) => words.clone(),
        };
        Self::without_place(Code::Unreadable, format!("cannot read `{path}`: {why}"))
    }
}
