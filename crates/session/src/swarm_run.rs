//! A compiled circuit's swarm, run through inputs in full physics.

use crate::compile::Compiled;
use crate::observer::Observer;
use nbc_sim::Simulator;
use nbc_swarm::{LiveSwarm, Room, SwarmTrace};

/// The length of the ground of a live swarm: enough for a robot that moves by its own width in each of this many
/// cycles.
pub(super) const LIVE_CYCLES: usize = 1000;

/// A swarm with its trace.
#[derive(Clone, Debug)]
pub struct SwarmRun {
    /// The circuit, compiled.
    pub compiled: Compiled,
    /// The bits and the path of each robot.
    pub trace: SwarmTrace,
}

/// How a session's swarms are simulated.
#[derive(Clone, Debug, Default)]
pub(super) struct Physics {
    /// The simulator of their robots.
    pub simulator: Simulator,
    /// The room for a recording of the robots' poses, if one is made.
    pub poses: Option<Room>,
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunEnd {
    /// It was completed.
    Complete,
    /// The observer cancelled it; the results cover the part before.
    Cancelled,
}

impl Physics {
    /// A swarm at its start, with ground for that many cycles.
    pub fn swarm(&self, compiled: &Compiled, cycles: usize) -> LiveSwarm {
        LiveSwarm::new(&self.simulator, &compiled.assembly, cycles, compiled.plan.window as usize, self.poses)
    }

    /// Runs a swarm with these input bits in each cycle.
    pub fn run(
        &self,
        compiled: &Compiled,
        inputs: Vec<Vec<bool>>,
        observer: &mut dyn Observer,
    ) -> (SwarmTrace, RunEnd) {
        run(self.swarm(compiled, inputs.len()), &inputs, observer)
    }
}

/// Continues a swarm with these input bits in each cycle.
pub(super) fn run(swarm: LiveSwarm, inputs: &[Vec<bool>], observer: &mut dyn Observer) -> (SwarmTrace, RunEnd) {
    run_until(swarm, inputs, 0, &mut |_| false, observer)
}

/// Continues a swarm with these input bits in each cycle, of which the first `done` have passed already. Stops after
/// the first cycle for whose trace `is_enough` is true.
pub(super) fn run_until(
    mut swarm: LiveSwarm,
    inputs: &[Vec<bool>],
    done: usize,
    is_enough: &mut dyn FnMut(&SwarmTrace) -> bool,
    observer: &mut dyn Observer,
) -> (SwarmTrace, RunEnd) {
    let all = inputs.len() as u64;
    for (cycle, inputs) in (1..).zip(inputs).skip(done) {
        if swarm.step(inputs).is_err() || is_enough(swarm.trace()) {
            observer.progress(all, all);
            break;
        }
        observer.progress(cycle, all);
        let is_cancelled = observer.is_cancelled() && cycle < all;
        if let Some(keeper) = observer.keeper()
            && (is_cancelled || keeper.is_due())
        {
            keeper.keep(&swarm.keep());
        }
        if is_cancelled {
            return (swarm.into_trace(), RunEnd::Cancelled);
        }
    }
    if let Some(keeper) = observer.keeper() {
        keeper.end();
    }
    (swarm.into_trace(), RunEnd::Complete)
}
