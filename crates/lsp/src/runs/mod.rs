//! Commands that run a source: each on a thread of its own, with progress, and to be cancelled.

mod command;
mod order;
mod outcome;
mod results;
mod watcher;
mod work;

use std::sync::Arc;
use std::thread;

use crossbeam_channel::{Receiver, Sender, unbounded};
use gen_lsp_types::ProgressToken;
use lsp_server::RequestId;
use serde_json::Value;

use nbc_base::source::SharedWorld;
use nbc_circuit::CancelFlag;
use nbc_session::Checked;

pub(super) use command::{COMMANDS, RUN, SCHEMATIC, TEST, TIMING};
pub(super) use order::{OrderError, RunOrder};
pub(super) use outcome::RunOutcome;
use results::ResultFolder;
pub(super) use watcher::RunEvent;
use watcher::Watcher;

/// The runs that are not yet finished.
pub(super) struct Runs {
    running: Vec<Running>,
    outbox: Sender<RunEvent>,
    inbox: Receiver<RunEvent>,
    results: ResultFolder,
}

struct Running {
    id: RequestId,
    token: Option<ProgressToken>,
    stop: CancelFlag,
}

impl Runs {
    pub(super) fn new() -> Self {
        results::remove_leftovers();
        let (outbox, inbox) = unbounded();
        Self { running: Vec::new(), outbox, inbox, results: ResultFolder::default() }
    }

    /// Receives the progress and the results of the runs.
    pub(super) fn events(&self) -> &Receiver<RunEvent> {
        &self.inbox
    }

    /// Starts a run that answers the request `id`.
    pub(super) fn start(
        &mut self,
        id: RequestId,
        token: Option<ProgressToken>,
        checked: Arc<Checked>,
        order: RunOrder,
        world: SharedWorld,
    ) {
        let stop = CancelFlag::default();
        self.running.push(Running { id: id.clone(), token: token.clone(), stop: stop.clone() });
        let (outbox, folder) = (self.outbox.clone(), self.results.path());
        thread::spawn(move || {
            let mut watcher = Watcher { token: token.clone(), outbox: outbox.clone(), stop, part: (0, 1), told: 0 };
            let result = folder.and_then(|folder| work::perform(world, &checked, &order, &folder, &mut watcher));
            let _ = outbox.send(RunEvent::Done { id, token, result });
        });
    }

    /// Forgets a run that is finished.
    pub(super) fn end(&mut self, id: &RequestId) {
        self.running.retain(|run| run.id != *id);
    }

    /// Stops the run that answers a request.
    pub(super) fn cancel_request(&self, id: &Value) {
        let is_meant = |run: &&Running| serde_json::to_value(&run.id).ok().as_ref() == Some(id);
        self.running.iter().filter(is_meant).for_each(Running::cancel);
    }

    /// Stops the run whose progress has this token.
    pub(super) fn cancel_progress(&self, token: &ProgressToken) {
        self.running.iter().filter(|run| run.token.as_ref() == Some(token)).for_each(Running::cancel);
    }
}

impl Running {
    fn cancel(&self) {
        self.stop.raise();
    }
}

impl Drop for Runs {
    /// Stops the runs, because no client waits for them.
    fn drop(&mut self) {
        self.running.iter().for_each(Running::cancel);
    }
}
