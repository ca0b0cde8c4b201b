//! Progress and cancellation of long work.

/// Follows long work. A door implements it for its bar, its page or its protocol. `()` ignores progress, and a closure
/// receives it.
pub trait Observer {
    /// `done` parts of `all` are done.
    fn progress(&mut self, done: u64, all: u64) {
        let _ = (done, all);
    }

    /// Whether the work should stop; called after each part.
    fn is_cancelled(&self) -> bool {
        false
    }
}

impl Observer for () {}

impl<F: FnMut(u64, u64)> Observer for F {
    fn progress(&mut self, done: u64, all: u64) {
        self(done, all);
    }
}
