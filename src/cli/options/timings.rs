//! `--timings`: measures and prints the time of each stage of a command.
//!
//! A [`Meter`] counts the time of simulations, a [`Timer`] that of the other stages of a command.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use clap::Args;

use crate::cli::Context;
use nbc_session::report::{Align, TextTable};
use nbc_sim::{LaneBackend, Meter, Part, Times};

#[derive(Args, Clone, Copy)]
pub struct Timings {
    /// Print the time of each stage to standard error; simulation is a few per cent slower
    #[arg(long)]
    timings: bool,
}

/// A stage of a command besides simulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TimedStage {
    Development,
    Archive,
    Output,
}

impl TimedStage {
    const ALL: [Self; 3] = [Self::Development, Self::Archive, Self::Output];

    fn name(self) -> &'static str {
        match self {
            Self::Development => "development",
            Self::Archive => "archive",
            Self::Output => "output",
        }
    }
}

pub struct Timer {
    /// Set by `--timings`.
    meter: Option<Arc<Meter>>,
    started: Instant,
    /// Nanoseconds of all threads.
    stages: [AtomicU64; TimedStage::ALL.len()],
}

pub fn meter() -> Arc<Meter> {
    let start = Instant::now();
    Arc::new(Meter::new(move || start.elapsed().as_nanos() as u64))
}

impl Timings {
    pub fn start(self) -> Timer {
        Timer { meter: self.timings.then(meter), started: Instant::now(), stages: Default::default() }
    }
}

impl Timer {
    /// With a meter if `--timings` was given.
    pub fn processor(&self) -> LaneBackend {
        LaneBackend { meter: self.meter.clone(), ..LaneBackend::default() }
    }

    pub fn time<T>(&self, stage: TimedStage, work: impl FnOnce() -> T) -> T {
        let started = Instant::now();
        let result = work();
        self.stages[stage as usize].fetch_add(started.elapsed().as_nanos() as u64, Ordering::Relaxed);
        result
    }

    fn seconds(&self, stage: TimedStage) -> f64 {
        self.stages[stage as usize].load(Ordering::Relaxed) as f64 / 1e9
    }

    pub fn report(&self, context: &Context) {
        if let Some(meter) = &self.meter {
            let stages = TimedStage::ALL.map(|stage| self.seconds(stage));
            context.log(&describe(&meter.times(), stages, self.started.elapsed().as_secs_f64()));
        }
    }
}

/// In order of [`Part::ALL`].
pub fn part_seconds(times: &Times) -> [f64; Part::ALL.len()] {
    times.nanoseconds.map(|nanoseconds| nanoseconds as f64 / 1e9)
}

fn describe(times: &Times, stages: [f64; TimedStage::ALL.len()], elapsed: f64) -> String {
    let mut table = TextTable::new(&[("stage", Align::Left), ("seconds", Align::Right), ("share", Align::Right)]);
    let parts = part_seconds(times);
    let names = Part::ALL.map(Part::name).into_iter().chain(TimedStage::ALL.map(TimedStage::name));
    let (simulated, all) = (parts.iter().sum::<f64>(), parts.iter().chain(&stages).sum::<f64>());
    for (name, seconds) in names.zip(parts.into_iter().chain(stages)).filter(|(_, seconds)| *seconds > 0.0) {
        table.push(vec![name.to_owned(), format!("{seconds:.3}"), format!("{:.1} %", 100.0 * seconds / all)]);
    }
    let speed = |seconds: f64| format!("{:.0}k", times.lane_substeps as f64 / seconds.max(1e-9) / 1e3);
    let (per_thread, in_all) = (speed(simulated), speed(elapsed));
    format!(
        "{table}{all:.3} s of all threads in {elapsed:.3} s; {per_thread} lane-substeps per second and thread, \
         {in_all} in all\n"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stages_without_time_are_left_out() {
        let times = Times {
            nanoseconds: [3_000_000_000, 1_000_000_000, 500_000_000, 250_000_000, 0],
            lane_substeps: 9_500_000,
        };
        insta::assert_snapshot!(describe(&times, [0.0, 0.0, 0.25], 2.5), @"
        stage        seconds   share
        springs        3.000  60.0 %
        contact        1.000  20.0 %
        limits         0.500  10.0 %
        bookkeeping    0.250   5.0 %
        output         0.250   5.0 %
        5.000 s of all threads in 2.500 s; 2000k lane-substeps per second and thread, 3800k in all
        ");
    }
}
