//! Files, examples, and what a page is told first.

use serde::Serialize;
#[cfg(test)]
use ts_rs::TS;

/// The answer to `hello`.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct Greeting {
    pub(crate) version: &'static str,
    /// The name of the folder.
    pub(crate) folder: String,
    /// Its `file:` URI, for the language server.
    pub(crate) root: String,
    /// The file to open first, if the command line names one.
    pub(crate) file: Option<String>,
    pub(crate) files: Vec<FileEntry>,
    pub(crate) examples: Vec<ExampleEntry>,
    pub(crate) limits: PlayLimits,
    /// Whether pages with the whole program in them can be made.
    pub(crate) live_pages: bool,
    /// The address of a page that everybody can open, for links to it.
    pub(crate) public_page: Option<String>,
    /// Whether there is a class to join.
    pub(crate) class: bool,
    pub(crate) cycle_seconds: f64,
}

/// What a page may ask for at most.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct PlayLimits {
    /// Robots of a swarm.
    pub(crate) robots: usize,
    /// Cycles that can be gone back.
    pub(crate) cycles: u32,
    /// Bytes of a message.
    pub(crate) message: usize,
}

/// A file of the served folder.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct FileEntry {
    pub(crate) path: String,
    pub(crate) size: u64,
}

/// An example that comes with the program.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct ExampleEntry {
    pub(crate) name: String,
    pub(crate) about: String,
}

/// A file or an example.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct FileText {
    pub(crate) path: String,
    pub(crate) text: String,
    /// A text that changes with the file; none for an example.
    pub(crate) stamp: Option<String>,
}

/// A file that was saved.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct FileStamp {
    pub(crate) stamp: Option<String>,
}

/// A file that was read or saved and has another stamp, or none because it is gone.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct FileChange {
    pub(crate) path: String,
    pub(crate) stamp: Option<String>,
}

/// A file to take away.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct TakenFile {
    /// Its address, relative to the page. It works once.
    pub(crate) url: String,
    pub(crate) name: String,
}
