//! Who reads files: the core asks a [`World`], the command line gives it the disk, tests give it memory.

use std::collections::BTreeMap;

/// Why a file could not be read as source text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FileError {
    /// No file has that path.
    NotFound,
    /// The path leads to a folder, a pipe, a device, with its article.
    NotRegular(&'static str),
    /// The file has more bytes than its reader takes.
    TooLarge {
        /// The largest size read, in bytes.
        limit: u64,
    },
    /// The bytes are not UTF-8 text.
    NotText {
        /// The first offending byte's offset.
        offset: usize,
    },
    /// The operating system refused; its words.
    Io(String),
}

/// The outside as the core sees it: a place where source files are.
pub trait World {
    /// The text of the file at `path`.
    fn read(&self, path: &str) -> Result<String, FileError>;

    /// The names of what is in a folder, in order.
    fn list(&self, folder: &str) -> Result<Vec<String>, FileError>;

    /// The one name of the file at `path`, however many paths and links lead to it.
    fn identity(&self, path: &str) -> String {
        path.to_owned()
    }
}

/// Files kept in memory, for tests and for programs that make their source.
#[derive(Clone, Debug, Default)]
pub struct MemoryWorld {
    files: BTreeMap<String, String>,
}

impl MemoryWorld {
    /// Puts a file at `path`, replacing what was there.
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
