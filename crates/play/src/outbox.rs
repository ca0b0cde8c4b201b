//! The messages to send to a page. Texts wait in a queue. Of the frames of a swarm only the newest is kept, so that a
//! slow page does not slow down the swarm.

use std::sync::{Arc, Condvar, Mutex, PoisonError};

use axum::extract::ws::{Message, Utf8Bytes};
use tokio::sync::{Notify, mpsc};

use crate::message::{Nothing, PlayEvent, RequestResult, ServerMessage};
use crate::refusal::Refused;

/// The most texts that wait, and their bytes; one text alone may be longer. A thread that adds more waits until the
/// page has received some.
const ROOM: usize = 256;
const MOST_BYTES: usize = 4 << 20;

/// The end that takes messages. Clones share one queue.
#[derive(Clone)]
pub(super) struct Outbox {
    texts: mpsc::Sender<Utf8Bytes>,
    load: Arc<Load>,
    frame: Arc<FrameSlot>,
}

/// The end from which a socket reads messages.
pub(super) struct Outgoing {
    texts: mpsc::Receiver<Utf8Bytes>,
    load: Arc<Load>,
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

/// The bytes of the texts that wait; `None` after the page has left, when threads do not wait.
struct Load {
    bytes: Mutex<Option<usize>>,
    less: Condvar,
}

impl Load {
    /// Adds a text as soon as there is room.
    fn add(&self, size: usize) {
        let bytes = self.bytes.lock().unwrap_or_else(PoisonError::into_inner);
        let is_full = |bytes: &mut Option<usize>| bytes.is_some_and(|bytes| bytes > 0 && bytes + size > MOST_BYTES);
        let mut bytes = self.less.wait_while(bytes, is_full).unwrap_or_else(PoisonError::into_inner);
        *bytes = bytes.map(|bytes| bytes + size);
    }

    /// Removes one text of that size, or all texts because the page has left.
    fn take(&self, size: Option<usize>) {
        let mut bytes = self.bytes.lock().unwrap_or_else(PoisonError::into_inner);
        *bytes = bytes.zip(size).map(|(bytes, size)| bytes.saturating_sub(size));
        self.less.notify_all();
    }
}

/// The two ends of a new queue.
pub(super) fn outbox() -> (Outbox, Outgoing) {
    let (texts, incoming) = mpsc::channel(ROOM);
    let load = Arc::new(Load { bytes: Mutex::new(Some(0)), less: Condvar::new() });
    let frame = Arc::new(FrameSlot::default());
    (Outbox { texts, load: load.clone(), frame: frame.clone() }, Outgoing { texts: incoming, load, frame })
}

impl Outbox {
    /// Sends a message. Nobody reads it when the page is gone.
    fn tell(&self, message: &ServerMessage) {
        self.send(serde_json::to_string(message).expect("messages are data"));
    }

    /// Sends an event.
    pub(super) fn event(&self, event: PlayEvent) {
        self.tell(&ServerMessage::Event(event));
    }

    /// Reports how much of the request `id` is done, and how much there is to do.
    pub(super) fn progress(&self, id: u64, progress: [u64; 2]) {
        self.tell(&ServerMessage::Progress { id, progress });
    }

    /// Sends a text as it is.
    pub(super) fn send(&self, text: String) {
        self.load.add(text.len());
        let _ = self.texts.blocking_send(text.into());
    }

    /// Answers the request `id`.
    pub(super) fn answer(&self, id: u64, result: Result<RequestResult, Refused>) {
        self.tell(&match result {
            Ok(result) => ServerMessage::Result { id, result },
            Err(refused) => ServerMessage::Refused { id, error: refused.into() },
        });
    }

    /// Answers the request `id`, which has no result.
    pub(super) fn done(&self, id: u64, done: Result<(), Refused>) {
        match done {
            Ok(()) => self.tell(&ServerMessage::Done { id, ok: Nothing {} }),
            Err(refused) => self.answer(id, Err(refused)),
        }
    }

    /// Whether no frame is waiting.
    pub(super) fn has_room(&self) -> bool {
        self.frame.with(|frame| frame.is_none())
    }

    /// Sends a frame, instead of the one that still waits.
    pub(super) fn put(&self, frame: Vec<u8>) {
        self.frame.with(|slot| *slot = Some(frame));
        self.frame.filled.notify_one();
    }

    /// Removes the frame that waits. Returns whether there was one.
    pub(super) fn clear(&self) -> bool {
        self.frame.with(|slot| slot.take().is_some())
    }
}

impl Outgoing {
    /// The next message, texts first; `None` when the other end is closed. If this future is dropped, no message is
    /// lost.
    pub(super) async fn next(&mut self) -> Option<Message> {
        loop {
            tokio::select! {
                biased;
                text = self.texts.recv() => {
                    self.load.take(text.as_ref().map(|text| text.len()));
                    return text.map(Message::Text);
                }
                () = self.frame.filled.notified() => {
                    if let Some(frame) = self.frame.with(Option::take) {
                        return Some(Message::Binary(frame.into()));
                    }
                }
            }
        }
    }
}

impl Drop for Outgoing {
    fn drop(&mut self) {
        self.load.take(None);
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
        outbox.progress(7, [1, 2]);
        outbox.done(7, Ok(()));
        outbox.answer(8, Ok(RequestResult::Files(Vec::new())));
        outbox.event(PlayEvent::Stopped { reason: "a".to_owned() });
        let texts = [
            r#"{"id":7,"progress":[1,2]}"#,
            r#"{"id":7,"ok":{}}"#,
            r#"{"id":8,"to":"files","ok":[]}"#,
            r#"{"event":"stopped","reason":"a"}"#,
        ];
        for text in texts {
            assert_eq!(take(&mut outgoing), Message::Text(text.into()));
        }
        assert_eq!(take(&mut outgoing), Message::Binary(vec![2].into()));
        assert!(outbox.has_room());
    }

    #[test]
    fn texts_wait_for_room_until_the_page_is_gone() {
        let (outbox, mut outgoing) = outbox();
        let large = "x".repeat(MOST_BYTES - 1);
        // One alone may be as large as it likes.
        outbox.send("x".repeat(2 * MOST_BYTES));
        let (told, tells) = std::sync::mpsc::channel();
        let teller = std::thread::spawn(move || {
            for _ in 0..3 {
                outbox.send(large.clone());
                told.send(()).unwrap();
            }
        });
        let pause = std::time::Duration::from_millis(50);
        assert!(tells.recv_timeout(pause).is_err());
        take(&mut outgoing);
        tells.recv().unwrap();
        assert!(tells.recv_timeout(pause).is_err());
        drop(outgoing);
        teller.join().unwrap();
    }
}
