//! Hovers that wait a short time for figures that are being compiled.

use core::time::Duration;

use gen_lsp_types::Range;
use lsp_server::RequestId;

use crate::figures::Subject;

/// Users notice a longer delay. After that time a hover is shown without its figures.
pub(super) const PATIENCE: Duration = Duration::from_millis(400);

pub(super) struct WaitingHover {
    pub(super) id: RequestId,
    pub(super) path: String,
    pub(super) subject: Subject,
    pub(super) range: Option<Range>,
    pub(super) text: String,
    pub(super) until: Duration,
}

impl WaitingHover {
    pub(super) fn left(&self, now: Duration) -> Duration {
        self.until.saturating_sub(now)
    }
}
