//! Reading files: the core asks a [`World`]. The command line provides the disk; tests provide memory.

use std::collections::BTreeMap;

/// The reason why a file could not be read as source text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FileError {
    /// There is no file with this path.
    NotFound,
    /// The path leads to a folder, a pipe or a device; the text names it with its article.
    NotRegular(&'static str),
    /// The file is larger than the limit.
    TooLarge {
        /// The limit in bytes.
        limit: u64,
    },
    /// The bytes are not UTF-8 text.
    NotText {
        /// The offset of the first invalid byte.
        offset: usize,
    },
    /// The operating system's error message.
    Io(String),
}

/// The environment of the core: a place with source files.
pub trait World {
    /// The text of the file at `path`.
    fn read(&self, path: &str) -> Result<String, FileError>;

    /// The names in a folder, in order.
    fn list(&self, folder: &str) -> Result<Vec<String>, FileError>;

    /// The unique name of the file at `path`, however many paths and links lead to it.
    fn identity(&self, path: &str) -> String {
        path.to_owned()
    }
}

/// Files in memory, for tests and for programs that generate source text.
#[derive(Clone, Debug, Default)]
pub struct MemoryWorld {
    files: BTreeMap<String, String>,
}

impl MemoryWorld {
    /// Adds a file at `path`, replacing any other.
    pub fn insert(&mut self, path: impl Into<String>, text: impl Into<String>) {
        self.files.insert(path.into(), text.into());
    }
}

impl World for MemoryWorld {
    fn read(&self, path: &str) -> Result<String, FileError> {
        self.files.get(path).cloned().ok_or(FileError::NotFound)
    }

    fn list(&self, folder: &str) -> Result<Vec<String>, FileError> {
        let inside = |path: &String| Some(path.strip_prefix(folder)?.strip_prefix('/')?.to_owned());
        let names: Vec<_> = self.files.keys().filter_map(inside).collect();
        if names.is_empty() { Err(FileError::NotFound) } else { Ok(names) }
    }
}
