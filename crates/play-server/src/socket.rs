//! One web socket: texts in at a bounded rate and in bounded number, messages out.

use std::collections::VecDeque;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::{scope, sleep};
use std::time::{Duration, Instant};

use crossbeam_channel::Sender;
use tungstenite::protocol::frame::coding::CloseCode;
use tungstenite::protocol::{CloseFrame, Role, WebSocketConfig};
use tungstenite::{Message, Utf8Bytes, WebSocket};

use crate::connections::SharedStream;
use crate::post::Outgoing;
use nbc_base::budget::Limit;

/// A page that does not read for this time is disconnected.
const PATIENCE: Duration = Duration::from_secs(30);
/// Messages per second that a page may send on average, and how many at once.
const RATE: f64 = 200.0;
const BURST: f64 = 2000.0;

pub(super) const WAITING: usize = 64;
/// The bytes of messages that may wait for one page, and for all together. One message of a page may always wait.
const MOST_BYTES: usize = 4 << 20;
const MOST_IN_ALL: usize = 32 << 20;
const LOOK: Duration = Duration::from_millis(20);

/// While too many messages wait, the socket is not read, so further ones stay on the page's computer.
struct Backlog<'a> {
    sizes: VecDeque<usize>,
    bytes: usize,
    all: &'a AtomicUsize,
}

impl<'a> Backlog<'a> {
    fn new(all: &'a AtomicUsize) -> Self {
        Self { sizes: VecDeque::new(), bytes: 0, all }
    }

    fn push(&mut self, size: usize) {
        self.sizes.push_back(size);
        self.bytes += size;
        self.all.fetch_add(size, Ordering::Relaxed);
    }

    fn settle(&mut self, waiting: usize) {
        while self.sizes.len() > waiting
            && let Some(size) = self.sizes.pop_front()
        {
            self.bytes -= size;
            self.all.fetch_sub(size, Ordering::Relaxed);
        }
    }

    fn has_room(&self) -> bool {
        self.bytes == 0 || self.bytes < MOST_BYTES && self.all.load(Ordering::Relaxed) < MOST_IN_ALL
    }
}

impl Drop for Backlog<'_> {
    fn drop(&mut self) {
        self.settle(0);
    }
}

/// `rest` is what came after the page's request.
pub(super) fn pump(
    wire: SharedStream,
    rest: Vec<u8>,
    requests: Sender<Utf8Bytes>,
    outgoing: Outgoing,
    all: &AtomicUsize,
) {
    let most = Some(Limit::PageMessage.most() as usize);
    let config = Some(WebSocketConfig::default().max_message_size(most).max_frame_size(most));
    // Two ends of one connection; writes do not mix, because `SharedStream` writes each buffer as a whole.
    let mut writer = WebSocket::from_raw_socket(wire.clone(), Role::Server, config);
    let mut reader = WebSocket::from_partially_read(wire.clone(), rest, Role::Server, config);
    if wire.stream().set_read_timeout(None).is_err() || wire.stream().set_write_timeout(Some(PATIENCE)).is_err() {
        return;
    }
    let closed = wire.clone();
    scope(|scope| {
        scope.spawn(move || {
            while let Some(message) = outgoing.next()
                && writer.send(message).is_ok()
            {}
            closed.close();
        });
        read(&mut reader, &requests, all);
        // Without senders the visit ends, and with it the outgoing messages.
        drop(requests);
        wire.close();
    });
}

fn read(socket: &mut WebSocket<SharedStream>, requests: &Sender<Utf8Bytes>, all: &AtomicUsize) {
    let mut allowance = Allowance::new(Instant::now());
    let mut backlog = Backlog::new(all);
    while let Some(text) = receive(socket, &mut allowance) {
        let size = text.len();
        if requests.send(text).is_err() {
            return;
        }
        backlog.push(size);
        backlog.settle(requests.len());
        while !backlog.has_room() {
            sleep(LOOK);
            backlog.settle(requests.len());
        }
    }
}

struct Allowance {
    left: f64,
    at: Instant,
}

impl Allowance {
    fn new(now: Instant) -> Self {
        Self { left: BURST, at: now }
    }

    fn take(&mut self, now: Instant) -> bool {
        let earned = now.saturating_duration_since(self.at).as_secs_f64() * RATE;
        self.left = (self.left + earned).min(BURST) - 1.0;
        self.at = now;
        self.left >= 0.0
    }
}

fn receive(socket: &mut WebSocket<SharedStream>, allowance: &mut Allowance) -> Option<Utf8Bytes> {
    loop {
        let message = socket.read().ok()?;
        if !allowance.take(Instant::now()) {
            let _ = socket.close(Some(CloseFrame { code: CloseCode::Policy, reason: "too many messages".into() }));
            return None;
        }
        match message {
            Message::Text(text) => return Some(text),
            Message::Close(_) => {
                let _ = socket.flush();
                return None;
            }
            _ => {}
        }
    }
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

    #[test]
    fn what_waits_is_bounded_for_each_and_for_all_but_one_message_always_may() {
        let all = AtomicUsize::new(0);
        let mut first = Backlog::new(&all);
        first.push(MOST_BYTES - 1);
        assert!(first.has_room());
        first.push(1);
        assert!(!first.has_room());
        first.settle(1);
        assert!(first.has_room() && all.load(Ordering::Relaxed) == 1);
        let mut second = Backlog::new(&all);
        second.push(MOST_IN_ALL);
        assert!(!first.has_room() && Backlog::new(&all).has_room());
        drop(second);
        assert!(first.has_room());
        drop(first);
        assert_eq!(all.load(Ordering::Relaxed), 0);
    }
}
