//! A compiled circuit's swarm, run through inputs in full physics.

use crate::model::CYCLE_STEPS;
use crate::session::compile::Compiled;
use crate::session::observer::Observer;
use crate::sim::Simulator;
use crate::swarm::{self, Exposure, SwarmTrace};

/// A swarm with what it did.
#[derive(Clone, Debug)]
pub struct SwarmRun {
    /// The circuit, compiled.
    pub compiled: Compiled,
    /// What its robots did.
    pub trace: SwarmTrace,
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
    simulator: &Simulator,
    compiled: &Compiled,
    inputs: Vec<Vec<bool>>,
    observer: &mut dyn Observer,
) -> (SwarmTrace, RunEnd) {
    let all = inputs.len();
    let exposure = Exposure { inputs, cycle_steps: CYCLE_STEPS, window: compiled.plan.window as usize };
    let mut observe = |done| observer.progress(done as u64, all as u64);
    let trace = swarm::simulate(simulator, &compiled.assembly, &exposure, &mut observe);
    (trace, RunEnd::Complete)
}
