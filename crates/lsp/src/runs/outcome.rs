//! The result of a command.

use serde::Serialize;

use crate::uri;
use nbc_base::source::SharedWorld;

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
    /// A result with the file of the world that shows it.
    pub(super) fn new(passed: Option<bool>, text: String, path: Option<String>, world: &SharedWorld) -> Self {
        Self { passed, text, page: path.as_deref().map(|path| uri::uri(&**world, path).0), path }
    }
}
