//! Hovers that wait a short time for figures that are being compiled.

use core::time::Duration;

use gen_lsp_types::Range;
use lsp_server::RequestId;

use crate::figures::Subject;

/// The longest time that a hover waits for figures. Users notice a longer delay. After that time it is shown without.
pub(super) const PATIENCE: Duration = Duration::from_millis(400);

/// A hover that waits for the figures of a subject.
pub(super) struct WaitingHover {
    pub(super) id: RequestId,
    /// The path of the source.
    pub(super) path: String,
    pub(super) subject: Subject,
    pub(super) range: Option<Range>,
    /// What is known already.
    pub(super) text: String,
    /// When it has waited long enough.
    pub(super) until: Duration,
}

impl WaitingHover {
    /// The time that it still waits.
    pub(super) fn left(&self, now: Duration) -> Duration {
        self.until.saturating_sub(now)
    }
}
