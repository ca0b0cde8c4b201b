//! The messages to send to a page.

use std::sync::Arc;

use crate::message::{Nothing, PlayEvent, RequestResult, ServerMessage};
use crate::refusal::Refused;
use nbc_swarm::TestVerdict;

/// The way to one page. Only the newest frame of its swarm is kept, so that a slow page does not slow down the swarm.
pub trait Line: Send + Sync {
    fn text(&self, text: String);

    fn frame(&self, frame: Vec<u8>);

    fn has_room(&self) -> bool;

    fn remove_frame(&self) -> bool;

    /// Called when work has ended, so that the visit of this page is soon advanced.
    fn wake(&self);
}

#[derive(Clone)]
pub(super) struct Outbox(Arc<dyn Line>);

impl Outbox {
    pub(super) fn new(line: Arc<dyn Line>) -> Self {
        Self(line)
    }

    pub(super) fn line(&self) -> &dyn Line {
        &*self.0
    }

    fn tell(&self, message: &ServerMessage) {
        self.0.text(serde_json::to_string(message).expect("messages are data"));
    }

    pub(super) fn event(&self, event: PlayEvent) {
        self.tell(&ServerMessage::Event(event));
    }

    pub(super) fn progress(&self, id: u64, progress: [u64; 2]) {
        self.tell(&ServerMessage::Progress { id, progress });
    }

    pub(super) fn found(&self, id: u64, found: Vec<TestVerdict>) {
        self.tell(&ServerMessage::Found { id, found });
    }

    pub(super) fn answer(&self, id: u64, result: Result<RequestResult, Refused>) {
        self.tell(&match result {
            Ok(result) => ServerMessage::Result { id, result },
            Err(refused) => ServerMessage::Refused { id, error: refused.into() },
        });
    }

    pub(super) fn done(&self, id: u64, done: Result<(), Refused>) {
        match done {
            Ok(()) => self.tell(&ServerMessage::Done { id, ok: Nothing {} }),
            Err(refused) => self.answer(id, Err(refused)),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use super::*;

    #[derive(Default)]
    struct Texts(Mutex<Vec<String>>);

    impl Line for Texts {
        fn text(&self, text: String) {
            self.0.lock().unwrap().push(text);
        }

        fn frame(&self, _: Vec<u8>) {}

        fn has_room(&self) -> bool {
            true
        }

        fn remove_frame(&self) -> bool {
            false
        }

        fn wake(&self) {}
    }

    #[test]
    fn a_message_says_what_it_answers() {
        let texts = Arc::new(Texts::default());
        let outbox = Outbox::new(texts.clone());
        outbox.progress(7, [1, 2]);
        outbox.done(7, Ok(()));
        outbox.answer(8, Ok(RequestResult::Files(Vec::new())));
        outbox.event(PlayEvent::Stopped { reason: "a".to_owned() });
        let expected = [
            r#"{"id":7,"progress":[1,2]}"#,
            r#"{"id":7,"ok":{}}"#,
            r#"{"id":8,"to":"files","ok":[]}"#,
            r#"{"event":"stopped","reason":"a"}"#,
        ];
        assert_eq!(*texts.0.lock().unwrap(), expected);
    }
}
