//! What a page is still to be sent. Texts wait in a queue; of the swarm's frames only the newest waits, so that a slow
//! page never holds up the swarm.

use std::sync::{Arc, Mutex, PoisonError};

use axum::extract::ws::{Message, Utf8Bytes};
use serde_json::{Value, json};
use tokio::sync::{Notify, mpsc};

use crate::cli::play::refusal::Refusal;

/// Texts that may wait. Work that has more to tell waits until the page has received some.
const ROOM: usize = 256;

/// The end at which a session puts messages. Clones put them into the same box.
#[derive(Clone)]
pub(super) struct Outbox {
    texts: mpsc::Sender<Utf8Bytes>,
    frame: Arc<FrameSlot>,
}

/// The end from which a socket takes them.
pub(super) struct Outgoing {
    texts: mpsc::Receiver<Utf8Bytes>,
    frame: Arc<FrameSlot>,
}

#[derive(Default)]
struct FrameSlot {
    frame: Mutex<Option<Vec<u8>>>,
    filled: Notify,
}

impl FrameSlot {
    fn with<T>(&self, work: impl FnOnce(&mut Option<Vec<u8>>) -> T) -> T {
        work(&mut self.frame.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

/// The two ends of a new box.
pub(super) fn outbox() -> (Outbox, Outgoing) {
    let (texts, incoming) = mpsc::channel(ROOM);
    let frame = Arc::new(FrameSlot::default());
    (Outbox { texts, frame: frame.clone() }, Outgoing { texts: incoming, frame })
}

impl Outbox {
    /// Tells an event, or the progress of a request. Nobody reads it when the page is gone.
    pub(super) fn tell(&self, message: &Value) {
        let _ = self.texts.blocking_send(message.to_string().into());
    }

    /// Answers the request `id`.
    pub(super) fn answer(&self, id: u64, result: Result<Value, Refusal>) {
        self.tell(&match result {
            Ok(value) => json!({ "id": id, "ok": value }),
            Err(refusal) => json!({ "id": id, "error": refusal }),
        });
    }

    /// Whether a frame can be put.
    pub(super) fn has_room(&self) -> bool {
        self.frame.with(|frame| frame.is_none())
    }

    /// Puts a frame in place of one that still waits.
    pub(super) fn put(&self, frame: Vec<u8>) {
        self.frame.with(|slot| *slot = Some(frame));
        self.frame.filled.notify_one();
    }

    /// Takes back the frame that waits.
    pub(super) fn clear(&self) {
        self.frame.with(|slot| *slot = None);
    }
}

impl Outgoing {
    /// The next message, texts first; `None` when nobody can put any more. No message is lost when the wait is given
    /// up.
    pub(super) async fn next(&mut self) -> Option<Message> {
        loop {
            tokio::select! {
                biased;
                text = self.texts.recv() => return text.map(Message::Text),
                () = self.frame.filled.notified() => {
                    if let Some(frame) = self.frame.with(Option::take) {
                        return Some(Message::Binary(frame.into()));
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn take(outgoing: &mut Outgoing) -> Message {
        tokio::runtime::Builder::new_current_thread().build().unwrap().block_on(outgoing.next()).unwrap()
    }

    #[test]
    fn texts_keep_their_order_and_go_before_the_newest_frame() {
        let (outbox, mut outgoing) = outbox();
        outbox.put(vec![1]);
        assert!(!outbox.has_room());
        outbox.put(vec![2]);
        outbox.tell(&json!("a"));
        outbox.answer(7, Ok(json!({})));
        assert_eq!(take(&mut outgoing), Message::Text("\"a\"".into()));
        assert_eq!(take(&mut outgoing), Message::Text("{\"id\":7,\"ok\":{}}".into()));
        assert_eq!(take(&mut outgoing), Message::Binary(vec![2].into()));
        assert!(outbox.has_room());
    }
}
