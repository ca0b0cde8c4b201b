//! `--timings`: which stage of a command's work took how long.
//!
//! Simulation runs on many threads and tells its parts to a probe; what a command does itself, it times. Both are
//! booked here for the whole program.

use std::cell::Cell;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use clap::Args;

use crate::cli::Context;
use crate::report::{Align, Table};
use crate::sim::{Part, Simulator};

/// The option, for commands that simulate.
#[derive(Args, Clone, Copy)]
pub struct Timings {
    /// Print the time of each stage on standard error; this makes simulation a few percent slower
    #[arg(long)]
    timings: bool,
}

/// A stage of a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    Springs,
    Contact,
    Limits,
    Bookkeeping,
    Development,
    Archive,
    Output,
}

/// Nanoseconds of each stage, summed over all threads.
static NANOSECONDS: [AtomicU64; Stage::ALL.len()] = [const { AtomicU64::new(0) }; Stage::ALL.len()];
/// Substeps of single simulations.
static LANE_SUBSTEPS: AtomicU64 = AtomicU64::new(0);

thread_local! {
    static WATCH: Cell<Watch> = const { Cell::new(Watch { last: None, parts: [Duration::ZERO; Stage::ALL.len()], lane_substeps: 0 }) };
}

/// The time of a thread that is not yet added to the total.
#[derive(Clone, Copy)]
struct Watch {
    /// The end of the last part.
    last: Option<Instant>,
    parts: [Duration; Stage::ALL.len()],
    lane_substeps: u64,
}

impl Stage {
    pub const ALL: [Self; 7] =
        [Self::Springs, Self::Contact, Self::Limits, Self::Bookkeeping, Self::Development, Self::Archive, Self::Output];

    pub fn name(self) -> &'static str {
        match self {
            Self::Springs => "springs",
            Self::Contact => "contact",
            Self::Limits => "limits",
            Self::Bookkeeping => "bookkeeping",
            Self::Development => "development",
            Self::Archive => "archive",
            Self::Output => "output",
        }
    }

    /// The stage of a part of the simulation.
    fn of(part: Part) -> Option<Self> {
        match part {
            Part::Elsewhere => None,
            Part::Bookkeeping => Some(Self::Bookkeeping),
            Part::Contact => Some(Self::Contact),
            Part::Springs => Some(Self::Springs),
            Part::Limits => Some(Self::Limits),
        }
    }

    /// Whether the stage is part of simulation.
    fn is_simulation(self) -> bool {
        matches!(self, Self::Springs | Self::Contact | Self::Limits | Self::Bookkeeping)
    }
}

/// The probe of a simulation: measures the time since the last part on this thread, and adds it to the total once per
/// env step.
pub fn watch(part: Part, simulations: usize) {
    let now = Instant::now();
    let mut watch = WATCH.get();
    if let Some((stage, last)) = Stage::of(part).zip(watch.last) {
        watch.parts[stage as usize] += now - last;
    }
    match part {
        Part::Limits => watch.lane_substeps += simulations as u64,
        Part::Bookkeeping => watch.book(),
        Part::Elsewhere | Part::Contact | Part::Springs => {}
    }
    watch.last = Some(now);
    WATCH.set(watch);
}

impl Watch {
    fn book(&mut self) {
        for (stage, part) in Stage::ALL.into_iter().zip(&mut self.parts) {
            book(stage, std::mem::take(part));
        }
        LANE_SUBSTEPS.fetch_add(std::mem::take(&mut self.lane_substeps), Ordering::Relaxed);
    }
}

fn book(stage: Stage, time: Duration) {
    NANOSECONDS[stage as usize].fetch_add(time.as_nanos() as u64, Ordering::Relaxed);
}

/// Calls a function and adds its time to a stage.
pub fn time<T>(stage: Stage, work: impl FnOnce() -> T) -> T {
    let started = Instant::now();
    let result = work();
    book(stage, started.elapsed());
    result
}

/// Seconds of each stage so far, in order of [`Stage::ALL`].
pub fn seconds() -> [f64; Stage::ALL.len()] {
    Stage::ALL.map(|stage| NANOSECONDS[stage as usize].load(Ordering::Relaxed) as f64 / 1e9)
}

impl Timings {
    /// The simulator, with a probe if times are requested.
    pub fn simulator(self) -> Simulator {
        Simulator { probe: self.timings.then_some(watch), ..Simulator::default() }
    }

    /// Prints the times if requested; `started` is the start of the command.
    pub fn tell(self, started: Instant, context: &Context) {
        if self.timings {
            let substeps = LANE_SUBSTEPS.load(Ordering::Relaxed);
            context.log(&describe(&seconds(), substeps, started.elapsed().as_secs_f64()));
        }
    }
}

/// A table of the stages that took time, and the speed of simulation.
fn describe(seconds: &[f64], lane_substeps: u64, elapsed: f64) -> String {
    let mut table = Table::new(&[("stage", Align::Left), ("seconds", Align::Right), ("share", Align::Right)]);
    let all: f64 = seconds.iter().sum();
    for (stage, seconds) in Stage::ALL.iter().zip(seconds).filter(|(_, seconds)| **seconds > 0.0) {
        let share = format!("{:.1} %", 100.0 * seconds / all);
        table.push(vec![stage.name().to_owned(), format!("{seconds:.3}"), share]);
    }
    let stages = Stage::ALL.iter().zip(seconds).filter(|(stage, _)| stage.is_simulation());
    let simulated: f64 = stages.map(|(_, seconds)| seconds).sum();
    let speed = |seconds: f64| format!("{:.0}k", lane_substeps as f64 / seconds.max(1e-9) / 1e3);
    let (a_thread, in_all) = (speed(simulated), speed(elapsed));
    format!(
        "{table}all threads together {all:.3} s, in {elapsed:.3} s; {a_thread} lane-substeps a second and thread, {in_all} in all\n"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stages_without_time_are_left_out() {
        insta::assert_snapshot!(describe(&[3.0, 1.0, 0.5, 0.25, 0.0, 0.0, 0.25], 9_500_000, 2.5), @"
        stage        seconds   share
        springs        3.000  60.0 %
        contact        1.000  20.0 %
        limits         0.500  10.0 %
        bookkeeping    0.250   5.0 %
        output         0.250   5.0 %
        all threads together 5.000 s, in 2.500 s; 2000k lane-substeps a second and thread, 3800k in all
        ");
    }
}
