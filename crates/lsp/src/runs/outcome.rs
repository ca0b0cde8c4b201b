//! The result of a command.

use serde::Serialize;

use crate::uri;
use nbc_base::source::SharedWorld;

#[derive(Clone, Debug, Serialize)]
pub(crate) struct RunOutcome {
    /// Whether every test passed and no robot failed; `None` if there was no test and no robot failed.
    pub(super) passed: Option<bool>,
    pub(crate) text: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) page: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) path: Option<String>,
}

impl RunOutcome {
    pub(super) fn new(passed: Option<bool>, text: String, path: Option<String>, world: &SharedWorld) -> Self {
        Self { passed, text, page: path.as_deref().map(|path| uri::uri(&**world, path).0), path }
    }
}
