//! The socket of a page's requests and of its swarm's frames.

use std::sync::Arc;
use std::thread;

use axum::extract::ws::WebSocket;
use tokio::sync::mpsc;

use crate::outbox::outbox;
use crate::served::Served;
use crate::socket::{WAITING, pump};
use crate::visit::Visit;

/// Serves one page until it is gone.
pub(super) async fn serve(served: Arc<Served>, socket: WebSocket) {
    let (requests, waiting) = mpsc::channel(WAITING);
    let (inbox, outgoing) = outbox();
    let visited = served.clone();
    thread::spawn(move || Visit::new(visited, inbox).serve(waiting));
    pump(socket, requests, outgoing, &served.waiting).await;
}
