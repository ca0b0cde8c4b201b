//! The progress display of all runs in progress together.

use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::cli::Progress;

#[derive(Default)]
pub(super) struct OpenRuns(Mutex<State>);

#[derive(Default)]
struct State {
    runs: usize,
    /// Done and total.
    generations: (u64, u64),
    bar: Option<Progress>,
}

impl OpenRuns {
    /// Counts a run that has some of its generations.
    pub(super) fn begin(&self, has: u32, all: u32) {
        let mut state = self.lock();
        if state.runs == 0 {
            state.generations = (0, 0);
        }
        state.runs += 1;
        state.generations.0 += u64::from(has);
        state.generations.1 += u64::from(all);
        state.bar = None;
        state.bar = Some(Progress::resumed("generations", state.generations.0, state.generations.1));
    }

    /// Counts a generation, and shows a note on its run if no other is in progress.
    pub(super) fn advance(&self, note: Option<String>) {
        let mut state = self.lock();
        state.generations.0 += 1;
        let note = note.filter(|_| state.runs == 1);
        match (&state.bar, note) {
            (Some(bar), Some(note)) => bar.set_with_note(state.generations.0, note),
            (Some(bar), None) => bar.set(state.generations.0),
            (None, _) => {}
        }
    }

    pub(super) fn note(&self, note: String) {
        if let Some(bar) = &self.lock().bar {
            bar.note(note);
        }
    }

    /// Counts a run that has ended. The display is removed after the last one.
    pub(super) fn end(&self) {
        let mut state = self.lock();
        state.runs -= 1;
        if state.runs == 0 {
            state.bar = None;
        }
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
