//! One web socket: texts in at a bounded rate, messages out.

use std::time::{Duration, Instant};

use axum::extract::ws::{CloseFrame, Message, Utf8Bytes, WebSocket, close_code};
use tokio::time::timeout;

/// The time for which a page may not read before it is disconnected.
const PATIENCE: Duration = Duration::from_secs(30);
/// Messages a second that a page may send for long, and how many at once.
const RATE: f64 = 200.0;
const BURST: f64 = 2000.0;

/// Messages that may still be sent.
pub(super) struct Allowance {
    left: f64,
    at: Instant,
}

impl Allowance {
    pub(super) fn new(now: Instant) -> Self {
        Self { left: BURST, at: now }
    }

    /// Takes one message, if there is one left.
    pub(super) fn take(&mut self, now: Instant) -> bool {
        let earned = now.saturating_duration_since(self.at).as_secs_f64() * RATE;
        self.left = (self.left + earned).min(BURST) - 1.0;
        self.at = now;
        self.left >= 0.0
    }
}

/// The text of the next message; `None` when the page is gone, broke the protocol, or sends too much.
pub(super) async fn receive(socket: &mut WebSocket, allowance: &mut Allowance) -> Option<Utf8Bytes> {
    loop {
        let message = socket.recv().await?.ok()?;
        if !allowance.take(Instant::now()) {
            let frame = CloseFrame { code: close_code::POLICY, reason: "too many messages".into() };
            let _ = timeout(PATIENCE, socket.send(Message::Close(Some(frame)))).await;
            return None;
        }
        match message {
            Message::Text(text) => return Some(text),
            Message::Close(_) => return None,
            Message::Binary(_) | Message::Ping(_) | Message::Pong(_) => {}
        }
    }
}

/// Sends a message; false when the page is gone or does not read.
pub(super) async fn send(socket: &mut WebSocket, message: Message) -> bool {
    matches!(timeout(PATIENCE, socket.send(message)).await, Ok(Ok(())))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_may_send_bursts_but_not_forever() {
        let start = Instant::now();
        let mut allowance = Allowance::new(start);
        assert!((0..2000).all(|_| allowance.take(start)));
        assert!(!allowance.take(start));
        assert!(allowance.take(start + Duration::from_secs(1)));
    }
}
