//! The socket of a page's requests and of its swarm's frames.

use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

use axum::extract::ws::{Utf8Bytes, WebSocket};
use tokio::sync::mpsc;
use tokio::time::interval;

use crate::cli::play::outbox::outbox;
use crate::cli::play::served::Served;
use crate::cli::play::socket::{Allowance, receive, send};
use crate::cli::play::visit::Visit;

/// Requests that may wait for the one before.
const WAITING: usize = 64;
/// The time between two pauses, in which a visit looks after its files.
const PAUSE: Duration = Duration::from_millis(500);

/// Serves one page until it is gone.
pub(super) async fn serve(served: Arc<Served>, mut socket: WebSocket) {
    let (requests, waiting) = mpsc::channel(WAITING);
    let (inbox, mut outgoing) = outbox();
    thread::spawn(move || Visit::new(served, inbox).serve(waiting));
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
