//! Progress on standard error: a bar on a terminal; elsewhere, such as in a log file, a line now and then.

use std::io::{self, Write};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Dropping it removes the bar.
pub struct Progress {
    bar: ProgressBar,
    started: Instant,
    state: Mutex<State>,
}

#[derive(Clone, Debug)]
struct State {
    /// Such as `measuring`.
    what: &'static str,
    /// Done before the display started.
    from: u64,
    done: u64,
    total: u64,
    note: String,
    /// When the next line is due without a terminal.
    next: Duration,
}

/// The time before the first line, and the first interval between lines.
const LEAST: Duration = Duration::from_secs(10);
/// The longest interval between lines.
const MOST: Duration = Duration::from_secs(60);

impl Progress {
    pub fn new(what: &'static str, total: u64) -> Self {
        Self::resumed(what, 0, total)
    }

    /// Continues after `from` pieces, which are not counted in the speed.
    pub fn resumed(what: &'static str, from: u64, total: u64) -> Self {
        let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::stderr_with_hz(10));
        let style = ProgressStyle::with_template("{prefix:>12} [{bar:30}] {pos}/{len}{msg}");
        bar.set_style(style.expect("a well-formed template").progress_chars("=> "));
        bar.set_prefix(what);
        bar.set_position(from);
        let state = State { what, from, done: from, total, note: String::new(), next: LEAST };
        Self { bar, started: Instant::now(), state: Mutex::new(state) }
    }

    pub fn set(&self, done: u64) {
        self.change(|state| state.done = done);
    }

    pub fn add(&self, more: u64) {
        self.change(|state| state.done += more);
    }

    /// An observer of one of several parts of the work, which counts from 0.
    pub fn part(&self) -> impl FnMut(u64, u64) {
        let mut before = 0;
        move |done, _| self.add(done - std::mem::replace(&mut before, done))
    }

    /// An observer of the whole work, which also knows the total.
    pub fn whole(&self) -> impl FnMut(u64, u64) {
        |done, total| self.change(|state| (state.done, state.total) = (done, total))
    }

    pub fn set_with_note(&self, done: u64, note: String) {
        self.change(|state| (state.done, state.note) = (done, note));
    }

    pub fn note(&self, note: String) {
        self.change(|state| state.note = note);
    }

    /// Calls a function that prints, with the bar hidden.
    pub fn suspend<T>(&self, work: impl FnOnce() -> T) -> T {
        self.bar.suspend(work)
    }

    fn change(&self, change: impl FnOnce(&mut State)) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        change(&mut state);
        let elapsed = self.started.elapsed();
        if self.bar.is_hidden() {
            if let Some(line) = state.line(elapsed) {
                // If standard error is closed, there is nowhere to report it.
                let _ = io::stderr().write_all(line.as_bytes());
            }
        } else {
            self.bar.set_length(state.total);
            self.bar.set_position(state.done);
            self.bar.set_message(state.rest(elapsed));
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

impl State {
    /// Pieces of work, of less than a tenth of all, after which the remaining time is known.
    const SAMPLE: u64 = 100;

    /// A line for a log, if one is due.
    fn line(&mut self, elapsed: Duration) -> Option<String> {
        if self.done >= self.total || elapsed < self.next {
            return None;
        }
        self.next = elapsed + elapsed.clamp(LEAST, MOST);
        Some(format!("{}: {} of {}{}\n", self.what, self.done, self.total, self.rest(elapsed)))
    }

    fn rest(&self, elapsed: Duration) -> String {
        let left = self.left(elapsed).map(|left| format!("about {} left", duration(left)));
        [Some(self.note.clone()).filter(|note| !note.is_empty()), left]
            .into_iter()
            .flatten()
            .map(|text| format!(", {text}"))
            .collect()
    }

    /// The remaining time at the speed so far; unknown at the start, when a few pieces may take longer than others.
    fn left(&self, elapsed: Duration) -> Option<Duration> {
        let (made, rest) = (self.done.saturating_sub(self.from), self.total.saturating_sub(self.done));
        let is_start = made < Self::SAMPLE && made * 10 < made + rest;
        if made == 0 || rest == 0 || is_start || elapsed < Duration::from_secs(1) {
            return None;
        }
        Duration::try_from_secs_f64(elapsed.as_secs_f64() * rest as f64 / made as f64).ok()
    }
}

/// At least one second.
fn duration(time: Duration) -> String {
    let seconds = time.as_secs_f64();
    if seconds < 99.5 {
        format!("{:.0} s", seconds.max(1.0))
    } else if seconds < 99.5 * 60.0 {
        format!("{:.0} min", seconds / 60.0)
    } else {
        format!("{:.1} h", seconds / 3600.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn state(from: u64, done: u64, total: u64) -> State {
        State { what: "measuring", from, done, total, note: String::new(), next: LEAST }
    }

    fn rest(state: &State, seconds: f64) -> String {
        state.rest(Duration::from_secs_f64(seconds))
    }

    #[test]
    fn the_remaining_time_is_shown_when_known_and_is_never_zero() {
        assert_eq!(rest(&state(0, 0, 64), 50.0), "", "nothing is done yet");
        assert_eq!(rest(&state(0, 16, 64), 60.0), ", about 3 min left");
        assert_eq!(rest(&state(0, 16, 64), 0.2), "", "too early to tell");
        assert_eq!(rest(&state(0, 9_999, 10_000), 2.0), ", about 1 s left");
        assert_eq!(rest(&state(0, 64, 64), 60.0), "", "all is done");
        assert_eq!(rest(&state(500, 550, 1000), 60.0), ", about 9 min left", "what was there before took no time");
        assert_eq!(rest(&state(0, 4, 256), 9.0), "", "too few of many");
        assert_eq!(rest(&state(0, 100, 10_000), 10.0), ", about 16 min left");
        let noted = State { note: "2 behaviors".to_owned(), ..state(0, 1, 5) };
        assert_eq!(rest(&noted, 10_000.0), ", 2 behaviors, about 11.1 h left");
    }

    #[test]
    fn a_log_has_a_line_after_ten_seconds_and_then_less_and_less_often() {
        let mut state = state(0, 16, 64);
        let mut told = Vec::new();
        for second in 0..240 {
            told.extend(state.line(Duration::from_secs(second)).map(|line| (second, line)));
        }
        let times: Vec<u64> = told.iter().map(|(second, _)| *second).collect();
        assert_eq!(times, [10, 20, 40, 80, 140, 200]);
        assert_eq!(told[2].1, "measuring: 16 of 64, about 2 min left\n");
    }
}
