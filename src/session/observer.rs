//! Who is told how far long work is, and may cancel it.

/// Follows long work. A door implements it for its bar, its page or its protocol; `()` watches nothing, and a closure is told the progress.
pub trait Observer {
    /// `done` parts of `all` are done.
    fn progress(&mut self, done: u64, all: u64) {
        let _ = (done, all);
    }

    /// Whether the work should stop; asked after each part.
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
