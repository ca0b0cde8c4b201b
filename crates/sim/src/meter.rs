//! The time of each part of a simulation. The physics reads no clock of its own; a caller provides a [`Meter`] with
//! one.

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    Springs,
    /// Contact with the ground and with the robot itself, and the instability test.
    Contact,
    Limits,
    /// Between env steps: stimuli, centers of mass, loading and unloading lanes.
    Bookkeeping,
    Device,
}

impl Part {
    pub const ALL: [Self; 5] = [Self::Springs, Self::Contact, Self::Limits, Self::Bookkeeping, Self::Device];

    pub const OF_LANES: [Self; 4] = [Self::Springs, Self::Contact, Self::Limits, Self::Bookkeeping];

    pub fn name(self) -> &'static str {
        match self {
            Self::Springs => "springs",
            Self::Contact => "contact",
            Self::Limits => "limits",
            Self::Bookkeeping => "bookkeeping",
            Self::Device => "device",
        }
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Times {
    /// Nanoseconds of each part, in order of [`Part::ALL`].
    pub nanoseconds: [u64; Part::ALL.len()],
    /// Substeps, counted for each robot.
    pub lane_substeps: u64,
}

pub struct Meter {
    clock: Box<dyn Fn() -> u64 + Send + Sync>,
    nanoseconds: [AtomicU64; Part::ALL.len()],
    lane_substeps: AtomicU64,
}

impl Meter {
    /// A meter at zero. The clock counts nanoseconds from any start and never runs backwards.
    pub fn new(clock: impl Fn() -> u64 + Send + Sync + 'static) -> Self {
        Self { clock: Box::new(clock), nanoseconds: Default::default(), lane_substeps: AtomicU64::new(0) }
    }

    pub fn times(&self) -> Times {
        let nanoseconds = Part::ALL.map(|part| self.nanoseconds[part as usize].load(Ordering::Relaxed));
        Times { nanoseconds, lane_substeps: self.lane_substeps.load(Ordering::Relaxed) }
    }
}

impl fmt::Debug for Meter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Meter").field("times", &self.times()).finish_non_exhaustive()
    }
}

#[derive(Debug)]
pub struct Stopwatch {
    meter: Arc<Meter>,
    last: u64,
    times: Times,
}

impl Stopwatch {
    pub fn new(meter: &Arc<Meter>) -> Self {
        Self { meter: Arc::clone(meter), last: (meter.clock)(), times: Times::default() }
    }

    pub fn resume(&mut self) {
        self.last = (self.meter.clock)();
    }

    /// The end of the length limits is the end of a substep of `lanes` robots.
    pub fn lap(&mut self, part: Part, lanes: usize) {
        let now = (self.meter.clock)();
        self.times.nanoseconds[part as usize] += now.saturating_sub(self.last);
        self.last = now;
        match part {
            Part::Limits => self.times.lane_substeps += lanes as u64,
            Part::Bookkeeping | Part::Device => self.report(),
            Part::Springs | Part::Contact => {}
        }
    }

    #[cfg(feature = "gpu")]
    pub fn lap_device(&mut self, lane_substeps: u64) {
        self.times.lane_substeps += lane_substeps;
        self.lap(Part::Device, 0);
    }

    fn report(&mut self) {
        let Times { nanoseconds, lane_substeps } = std::mem::take(&mut self.times);
        for (total, time) in self.meter.nanoseconds.iter().zip(nanoseconds) {
            total.fetch_add(time, Ordering::Relaxed);
        }
        self.meter.lane_substeps.fetch_add(lane_substeps, Ordering::Relaxed);
    }
}
