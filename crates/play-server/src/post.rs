//! The messages to send to a page. Texts wait in a queue, which is bounded.

use std::collections::VecDeque;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

use crossbeam_channel::{Receiver, Sender, bounded};
use tungstenite::Message;

use nbc_play::Line;

/// Texts that wait, and their bytes; one text alone may be longer. A thread that adds more waits.
const ROOM: usize = 256;
const MOST_BYTES: usize = 4 << 20;

pub(super) struct Post {
    queue: Arc<Queue>,
    wake: Sender<()>,
}

pub(super) struct Outgoing(Arc<Queue>);

#[derive(Default)]
struct Queue {
    waiting: Mutex<Waiting>,
    changed: Condvar,
}

#[derive(Default)]
struct Waiting {
    texts: VecDeque<String>,
    bytes: usize,
    frame: Option<Vec<u8>>,
    is_ended: bool,
}

impl Queue {
    fn lock(&self) -> MutexGuard<'_, Waiting> {
        self.waiting.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn wait(&self, is_early: impl Fn(&Waiting) -> bool) -> MutexGuard<'_, Waiting> {
        let is_early = |waiting: &mut Waiting| is_early(waiting);
        self.changed.wait_while(self.lock(), is_early).unwrap_or_else(PoisonError::into_inner)
    }

    fn end(&self) {
        self.lock().is_ended = true;
        self.changed.notify_all();
    }
}

/// The two ends of a new queue, and what arrives when its page is woken.
pub(super) fn post() -> (Post, Outgoing, Receiver<()>) {
    let queue = Arc::new(Queue::default());
    // Several calls before the visit is advanced are one.
    let (wake, woken) = bounded(1);
    (Post { queue: queue.clone(), wake }, Outgoing(queue), woken)
}

impl Line for Post {
    fn text(&self, text: String) {
        let size = text.len();
        let is_full = |waiting: &Waiting| {
            let has_room = waiting.texts.len() < ROOM && waiting.bytes + size <= MOST_BYTES;
            !(has_room || waiting.texts.is_empty() || waiting.is_ended)
        };
        let mut waiting = self.queue.wait(is_full);
        waiting.bytes += size;
        waiting.texts.push_back(text);
        self.queue.changed.notify_all();
    }

    fn frame(&self, frame: Vec<u8>) {
        self.queue.lock().frame = Some(frame);
        self.queue.changed.notify_all();
    }

    fn has_room(&self) -> bool {
        self.queue.lock().frame.is_none()
    }

    fn remove_frame(&self) -> bool {
        self.queue.lock().frame.take().is_some()
    }

    fn wake(&self) {
        let _ = self.wake.try_send(());
    }
}

impl Drop for Post {
    fn drop(&mut self) {
        self.queue.end();
    }
}

impl Outgoing {
    /// Waits for the next message, texts first; `None` after the last one.
    pub(super) fn next(&self) -> Option<Message> {
        let is_empty = |waiting: &Waiting| waiting.texts.is_empty() && waiting.frame.is_none() && !waiting.is_ended;
        let mut waiting = self.0.wait(is_empty);
        let Some(text) = waiting.texts.pop_front() else { return waiting.frame.take().map(Message::binary) };
        waiting.bytes -= text.len();
        self.0.changed.notify_all();
        Some(Message::text(text))
    }
}

impl Drop for Outgoing {
    fn drop(&mut self) {
        self.0.end();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_keep_their_order_and_go_before_the_newest_frame() {
        let (post, outgoing, _) = post();
        post.frame(vec![1]);
        assert!(!post.has_room());
        post.frame(vec![2]);
        post.text("a".to_owned());
        post.text("b".to_owned());
        let expected = [Message::text("a"), Message::text("b"), Message::binary(vec![2])];
        assert_eq!([(); 3].map(|()| outgoing.next().unwrap()), expected);
        assert!(post.has_room() && !post.remove_frame());
        drop(post);
        assert_eq!(outgoing.next(), None);
    }

    #[test]
    fn texts_wait_for_room_until_the_page_is_gone() {
        let (post, outgoing, _) = post();
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
        outgoing.next();
        tells.recv().unwrap();
        assert!(tells.recv_timeout(pause).is_err());
        drop(outgoing);
        teller.join().unwrap();
    }
}
