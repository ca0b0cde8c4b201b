//! A compiled circuit's swarm, run through inputs in full physics.

use crate::session::compile::Compiled;
use crate::session::observer::Observer;
use crate::sim::Simulator;
use crate::swarm::{self, Exposure, Room, SwarmTrace};

/// A swarm with what it did.
#[derive(Clone, Debug)]
pub struct SwarmRun {
    /// The circuit, compiled.
    pub compiled: Compiled,
    /// What its robots did.
    pub trace: SwarmTrace,
}

/// How a session's swarms are simulated.
#[derive(Clone, Debug, Default)]
pub(super) struct Physics {
    /// What simulates their robots.
    pub simulator: Simulator,
    /// The room for a recording of the robots' poses, if one is made.
    pub poses: Option<Room>,
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunEnd {
    /// All of it was done.
    Complete,
    /// The observer cancelled it: results are of what was done until then.
    Cancelled,
}

/// Runs a swarm with these input bits in each cycle.
pub(super) fn run(
    physics: &Physics,
    compiled: &Compiled,
    inputs: Vec<Vec<bool>>,
    observer: &mut dyn Observer,
) -> (SwarmTrace, RunEnd) {
    let all = inputs.len();
    let exposure = Exposure { inputs, window: compiled.plan.window as usize, poses: physics.poses };
    let mut observe = |done| observer.progress(done as u64, all as u64);
    let trace = swarm::simulate(&physics.simulator, &compiled.assembly, &exposure, &mut observe);
    (trace, RunEnd::Complete)
}
