//! A cycle of some robots of a swarm as plain data. Robots do not touch each other, so the parts of a swarm can be
//! simulated in different places at the same time.

use nbc_base::model::{Body, Pattern, Setting};
use nbc_sim::{Simulator, Snapshot};

/// Some robots of a swarm at the start of a cycle. What becomes of them depends on this alone.
#[derive(Clone, Debug, PartialEq)]
pub struct CyclePart {
    pub setting: Setting,
    pub bodies: Vec<Body>,
    pub starts: Vec<Snapshot>,
    pub patterns: Vec<Pattern>,
    /// The env steps of the cycle at whose end their states are read, in order. The last one ends the cycle.
    pub stops: Vec<u32>,
}

/// The states of the robots of a part, for each stop.
pub type PartStates = Vec<Vec<Snapshot>>;

impl CyclePart {
    pub fn simulate(&self, simulator: &Simulator) -> PartStates {
        let mut flock = simulator.flock(&self.setting, &self.bodies);
        self.starts.iter().enumerate().for_each(|(i, start)| flock.restore(i, start));
        let mut done = 0;
        let to_stop = |&stop: &u32| {
            flock.advance(&self.patterns, stop - done);
            done = stop;
            (0..flock.len()).map(|i| flock.snapshot(i)).collect()
        };
        self.stops.iter().map(to_stop).collect()
    }
}
