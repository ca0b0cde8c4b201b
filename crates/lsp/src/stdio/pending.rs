//! Messages that wait in the queue and would make the current check out of date.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use gen_lsp_types::LspNotificationMethod;
use lsp_server::Message;

use nbc_circuit::CancelFlag;

/// Counts waiting changes. While one waits, translations of Verilog are cancelled. Clones share their state.
#[derive(Clone, Debug, Default)]
pub(super) struct Pending(Arc<Mutex<State>>);

#[derive(Debug, Default)]
struct State {
    waiting: usize,
    is_over: bool,
    /// Raised while a change waits, and at the end.
    cancel: CancelFlag,
}

impl Pending {
    pub(super) fn add(&self, message: &Message) {
        if is_change(message) {
            let mut state = self.state();
            state.waiting += 1;
            state.cancel.raise();
        }
    }

    pub(super) fn take(&self, message: &Message) {
        if is_change(message) {
            let mut state = self.state();
            state.waiting -= 1;
            if state.waiting == 0 && !state.is_over {
                state.cancel = CancelFlag::default();
            }
        }
    }

    pub(super) fn end(&self) {
        let mut state = self.state();
        state.is_over = true;
        state.cancel.raise();
    }

    pub(super) fn cancel(&self) -> CancelFlag {
        self.state().cancel.clone()
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn is_change(message: &Message) -> bool {
    match message {
        Message::Request(request) => request.method == "shutdown",
        Message::Notification(told) => matches!(
            LspNotificationMethod::from(told.method.as_str()),
            LspNotificationMethod::TextDocumentDidChange
                | LspNotificationMethod::TextDocumentDidClose
                | LspNotificationMethod::WorkspaceDidChangeWatchedFiles
                | LspNotificationMethod::Exit
        ),
        Message::Response(_) => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lsp_server::Notification;

    #[test]
    fn translations_end_while_changes_wait_and_when_the_client_is_gone() {
        let pending = Pending::default();
        let message = |method: &str| Message::Notification(Notification::new(method.to_owned(), ()));
        let (change, other) = (message("textDocument/didChange"), message("initialized"));
        let first = pending.cancel();
        pending.add(&other);
        assert!(!first.is_raised());
        pending.add(&change);
        pending.add(&change);
        assert!(first.is_raised() && pending.cancel().is_raised());
        pending.take(&change);
        assert!(pending.cancel().is_raised(), "another change waits");
        pending.take(&change);
        let second = pending.cancel();
        assert!(!second.is_raised());
        pending.end();
        assert!(second.is_raised() && pending.cancel().is_raised());
    }
}
