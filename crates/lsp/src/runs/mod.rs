//! Commands that run a source: each is work beside all other, with progress, and can be cancelled.

mod order;
mod watcher;
mod work;

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

use gen_lsp_types::ProgressToken;
use lsp_server::RequestId;
use serde_json::Value;

use crate::shell::LanguageShell;
use nbc_base::source::SharedWorld;
use nbc_circuit::CancelFlag;
use nbc_session::Checked;

pub(super) use order::{COMMANDS, PROVE, RUN, RunOrder, SCHEMATIC, TEST, TIMING};
use watcher::Watcher;
pub(super) use watcher::{RunEvent, RunOutcome};

pub(super) struct Runs {
    shell: Arc<dyn LanguageShell>,
    running: Vec<Running>,
    events: (Sender<RunEvent>, Receiver<RunEvent>),
}

struct Running {
    id: RequestId,
    token: Option<ProgressToken>,
    stop: CancelFlag,
}

impl Runs {
    pub(super) fn new(shell: Arc<dyn LanguageShell>) -> Self {
        Self { shell, running: Vec::new(), events: channel() }
    }

    pub(super) fn event(&self) -> Option<RunEvent> {
        self.events.1.try_recv().ok()
    }

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
        let (events, shell) = (self.events.0.clone(), self.shell.clone());
        self.shell.start(Box::new(move || {
            let (told, waker) = (token.clone(), shell.clone());
            let mut watcher =
                Watcher { token: told, shell: waker, events: events.clone(), stop, part: (0, 1), told: 0 };
            let result = work::perform(world, &checked, &order, &*shell, &mut watcher);
            let _ = events.send(RunEvent::Done { id, token, result });
        }));
    }

    pub(super) fn end(&mut self, id: &RequestId) {
        self.running.retain(|run| run.id != *id);
    }

    pub(super) fn cancel_request(&self, id: &Value) {
        let is_meant = |run: &&Running| serde_json::to_value(&run.id).ok().as_ref() == Some(id);
        self.running.iter().filter(is_meant).for_each(Running::cancel);
    }

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
    fn drop(&mut self) {
        self.running.iter().for_each(Running::cancel);
    }
}
