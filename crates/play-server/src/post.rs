//! The messages to send to a page. Texts wait in a queue, which is bounded.

use std::sync::{Arc, Condvar, Mutex, PoisonError};

use axum::extract::ws::{Message, Utf8Bytes};
use crossbeam_channel::{Receiver, Sender, bounded};
use tokio::sync::{Notify, mpsc};

use nbc_play::Line;

/// The most texts that wait, and their bytes; one text alone may be longer. A thread that adds more waits until the
/// page has received some.
const ROOM: usize = 256;
const MOST_BYTES: usize = 4 << 20;

pub(super) struct Post {
    texts: mpsc::Sender<Utf8Bytes>,
    load: Arc<Load>,
    frame: Arc<FrameSlot>,
    wake: Sender<()>,
}

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

/// The two ends of a new queue, and what arrives when its page is woken.
pub(super) fn post() -> (Post, Outgoing, Receiver<()>) {
    let (texts, incoming) = mpsc::channel(ROOM);
    let load = Arc::new(Load { bytes: Mutex::new(Some(0)), less: Condvar::new() });
    let frame = Arc::new(FrameSlot::default());
    // Several calls before the visit is advanced are one.
    let (wake, woken) = bounded(1);
    let post = Post { texts, load: load.clone(), frame: frame.clone(), wake };
    (post, Outgoing { texts: incoming, load, frame }, woken)
}

impl Line for Post {
    fn text(&self, text: String) {
        self.load.add(text.len());
        let _ = self.texts.blocking_send(text.into());
    }

    fn frame(&self, frame: Vec<u8>) {
        self.frame.with(|slot| *slot = Some(frame));
        self.frame.filled.notify_one();
    }

    fn has_room(&self) -> bool {
        self.frame.with(|frame| frame.is_none())
    }

    fn remove_frame(&self) -> bool {
        self.frame.with(|slot| slot.take().is_some())
    }

    fn wake(&self) {
        let _ = self.wake.try_send(());
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
        let (post, mut outgoing, _) = post();
        post.frame(vec![1]);
        assert!(!post.has_room());
        post.frame(vec![2]);
        post.text("a".to_owned());
        post.text("b".to_owned());
        for text in ["a", "b"] {
            assert_eq!(take(&mut outgoing), Message::Text(text.into()));
        }
        assert_eq!(take(&mut outgoing), Message::Binary(vec![2].into()));
        assert!(post.has_room() && !post.remove_frame());
    }

    #[test]
    fn texts_wait_for_room_until_the_page_is_gone() {
        let (post, mut outgoing, _) = post();
        let large = "x".repeat(MOST_BYTES - 1);
        // One alone may be as large as it likes.
        post.text("x".repeat(2 * MOST_BYTES));
        let (told, tells) = std::sync::mpsc::channel();
        let teller = std::thread::spawn(move || {
            for _ in 0..3 {
                post.text(large.clone());
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
