//! Progress on standard error, for work of more than a second; silent where that is no terminal.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// A progress bar, gone without a trace when dropped.
pub struct Progress(ProgressBar);

impl Progress {
    /// A bar over `total` pieces of work, with a word for what is being done.
    pub fn new(what: &'static str, total: u64) -> Self {
        Self::with_template(total, "{msg:>12} [{bar:30}] {pos}/{len}, {eta} left").message(what)
    }

    /// A bar with a template of indicatif's.
    ///
    /// # Panics
    /// When the template is malformed.
    pub fn with_template(total: u64, template: &'static str) -> Self {
        let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::stderr_with_hz(10));
        bar.set_style(ProgressStyle::with_template(template).expect("a well-formed template").progress_chars("=> "));
        bar.enable_steady_tick(Duration::from_millis(200));
        Self(bar)
    }

    fn message(self, what: &'static str) -> Self {
        self.0.set_message(what);
        self
    }

    /// Says how much is done by now.
    pub fn set(&self, done: u64) {
        self.0.set_position(done);
    }

    /// Says how much there is to do.
    pub fn set_total(&self, total: u64) {
        self.0.set_length(total);
    }

    /// Says that `more` is done.
    pub fn add(&self, more: u64) {
        self.0.inc(more);
    }

    /// Replaces the word for what is being done.
    pub fn set_message(&self, message: impl Into<String>) {
        self.0.set_message(message.into());
    }

    /// Does something that prints, with the bar out of the way.
    pub fn suspend<T>(&self, work: impl FnOnce() -> T) -> T {
        self.0.suspend(work)
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
