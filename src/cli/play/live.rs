//! The socket of a page's requests and of its swarm's frames.

use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

use axum::extract::ws::{Utf8Bytes, WebSocket};
use tokio::sync::mpsc;
use tokio::time::interval;

use crate::circuit::CancelFlag;
use crate::cli::play::outbox::{Outgoing, outbox};
use crate::cli::play::served::Served;
use crate::cli::play::socket::{Allowance, receive, send};
use crate::cli::play::visit::Visit;

/// Requests that may wait for the one before.
const WAITING: usize = 64;
/// The time between two pauses, in which a visit looks after its files.
const PAUSE: Duration = Duration::from_millis(500);

/// Serves one page until it is gone.
pub(super) async fn serve(served: Arc<Served>, socket: WebSocket) {
    let (requests, waiting) = mpsc::channel(WAITING);
    let (inbox, outgoing) = outbox();
    let gone = CancelFlag::default();
    let visit_ends = gone.clone();
    thread::spawn(move || Visit::new(served, inbox, visit_ends).serve(waiting));
    exchange(socket, requests, outgoing).await;
    gone.raise();
}

/// Hands on requests and answers until the page is gone.
async fn exchange(mut socket: WebSocket, requests: mpsc::Sender<Utf8Bytes>, mut outgoing: Outgoing) {
    let mut allowance = Allowance::new(Instant::now());
    let mut pause = interval(PAUSE);
    // A request for which the visit has no time yet. Meanwhile answers still go out, for which the visit may wait.
    let mut next = None;
    loop {
        tokio::select! {
            text = receive(&mut socket, &mut allowance), if next.is_none() => match text {
                Some(text) => next = Some(text),
                None => return,
            },
            place = requests.reserve(), if next.is_some() => match (place, next.take()) {
                (Ok(place), Some(text)) => place.send(text),
                _ => return,
            },
            message = outgoing.next() => match message {
                Some(message) => if !send(&mut socket, message).await { return },
                None => return,
            },
            _ = pause.tick() => { let _ = requests.try_send(Utf8Bytes::default()); }
        }
    }
}
