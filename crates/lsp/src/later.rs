//! Hovers that wait a short time for figures that are being compiled.

use std::time::{Duration, Instant};

use gen_lsp_types::Range;
use lsp_server::RequestId;

use crate::figures::Subject;

/// The longest time that a hover waits for figures. Users notice a longer delay. After that time it is shown without.
const PATIENCE: Duration = Duration::from_millis(400);

/// A hover that waits for the figures of a subject.
pub(super) struct WaitingHover {
    pub(super) id: RequestId,
    /// The path of the source.
    pub(super) path: String,
    pub(super) subject: Subject,
    pub(super) range: Option<Range>,
    /// What is known already.
    pub(super) text: String,
    until: Instant,
}

impl WaitingHover {
    pub(super) fn new(id: RequestId, path: String, subject: Subject, range: Option<Range>, text: String) -> Self {
        Self { id, path, subject, range, text, until: Instant::now() + PATIENCE }
    }

    /// The time that it still waits.
    pub(super) fn left(&self) -> Duration {
        self.until.saturating_duration_since(Instant::now())
    }
}
