//! The socket of a page's requests and of its swarm's frames.

use std::sync::Arc;
use std::thread;

use axum::extract::ws::WebSocket;
use tokio::sync::mpsc;

use crate::cli::play::outbox::outbox;
use crate::cli::play::served::Served;
use crate::cli::play::socket::{WAITING, pump};
use crate::cli::play::visit::Visit;
use nbc_circuit::CancelFlag;

/// Serves one page until it is gone.
pub(super) async fn serve(served: Arc<Served>, socket: WebSocket) {
    let (requests, waiting) = mpsc::channel(WAITING);
    let (inbox, outgoing) = outbox();
    let gone = CancelFlag::default();
    let (visited, visit_ends) = (served.clone(), gone.clone());
    thread::spawn(move || Visit::new(visited, inbox, visit_ends).serve(waiting));
    pump(socket, requests, outgoing, &served.waiting).await;
    gone.raise();
}
