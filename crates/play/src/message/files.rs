//! Files, examples, and what a page is told first.

use serde::Serialize;

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct Greeting {
    pub(crate) version: &'static str,
    pub(crate) folder: String,
    /// The `file:` URI of the folder, for the language server.
    pub(crate) root: String,
    /// The file to open first.
    pub(crate) file: Option<String>,
    pub(crate) files: Vec<FileEntry>,
    pub(crate) examples: Vec<ExampleEntry>,
    pub(crate) limits: PlayLimits,
    /// Whether pages with the whole program in them can be made.
    pub(crate) live_pages: bool,
    /// The address of a public page, for links to it.
    pub(crate) public_page: Option<String>,
    pub(crate) class: bool,
    pub(crate) cycle_seconds: f64,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct PlayLimits {
    pub(crate) robots: usize,
    /// Cycles that can be gone back.
    pub(crate) cycles: u32,
    /// Bytes of a message.
    pub(crate) message: usize,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct FileEntry {
    pub(crate) path: String,
    pub(crate) size: u64,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct ExampleEntry {
    pub(crate) name: String,
    pub(crate) about: String,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct FileText {
    pub(crate) path: String,
    pub(crate) text: String,
    /// A text that changes with the file; none for an example.
    pub(crate) stamp: Option<String>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct FileStamp {
    pub(crate) stamp: Option<String>,
}

/// A file that was read or saved and has another stamp, or none because it is gone.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct FileChange {
    pub(crate) path: String,
    pub(crate) stamp: Option<String>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct TakenFile {
    /// Relative to the page. It works once.
    pub(crate) url: String,
    pub(crate) name: String,
}
