//! The result of a command.

use std::path::PathBuf;

use serde::Serialize;

use crate::uri;
use nbc_session::store::DiskWorld;

/// The result of a command.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct RunOutcome {
    /// Whether every test passed and no robot failed; none if there was no test and no robot failed.
    pub(super) passed: Option<bool>,
    /// A line for people.
    pub(crate) text: String,
    /// The URI of the page or picture.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) page: Option<String>,
    /// The path of the page or picture.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) path: Option<String>,
}

impl RunOutcome {
    /// A result with the file that shows it.
    pub(super) fn new(passed: Option<bool>, text: String, path: Option<PathBuf>) -> Self {
        let path = path.map(|path| path.to_string_lossy().into_owned());
        Self { passed, text, page: path.as_deref().map(|path| uri::uri(&DiskWorld, path).0), path }
    }
}
