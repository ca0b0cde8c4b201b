//! The observer of a run: reports its progress, and stops it.

use std::sync::Arc;
use std::sync::mpsc::Sender;

use gen_lsp_types::ProgressToken;
use lsp_server::RequestId;
use serde::Serialize;

use crate::shell::LanguageShell;
use crate::uri;
use crate::wording::RequestError;
use nbc_base::source::SharedWorld;
use nbc_circuit::CancelFlag;
use nbc_session::Observer;

pub(crate) enum RunEvent {
    Progress { token: ProgressToken, percentage: u32, message: String },
    Done { id: RequestId, token: Option<ProgressToken>, result: Result<RunOutcome, RequestError> },
}

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

pub(super) struct Watcher {
    pub(super) token: Option<ProgressToken>,
    pub(super) shell: Arc<dyn LanguageShell>,
    pub(super) events: Sender<RunEvent>,
    pub(super) stop: CancelFlag,
    /// The current part, from 0, and the number of parts.
    pub(super) part: (u64, u64),
    pub(super) told: u32,
}

impl Observer for Watcher {
    fn begin(&mut self, part: usize, parts: usize) {
        self.part = (part as u64, parts as u64);
    }

    fn is_cancelled(&self) -> bool {
        self.stop.is_raised()
    }

    fn progress(&mut self, done: u64, all: u64) {
        let (part, parts) = self.part;
        let percentage = ((part * all + done) * 100 / (parts * all).max(1)).min(100) as u32;
        let Some(token) = self.token.clone().filter(|_| percentage > self.told) else { return };
        self.told = percentage;
        let message = format!("{} of {parts}", part + 1);
        let _ = self.events.send(RunEvent::Progress { token, percentage, message });
        self.shell.wake();
    }
}
