//! A swarm in full physics from its start to the end of its stimulation.

use crate::{Assembly, LiveSwarm, Room, SwarmTrace};
use nbc_sim::Simulator;

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SwarmConditions {
    pub inputs: Vec<Vec<bool>>,
    /// Cycles over which a displacement is measured; its sign is the output. The paper's is one.
    pub window: usize,
    pub poses: Option<Room>,
}

/// Ends when a robot fails. Calls `observe` with the number of finished cycles after each cycle.
/// Panics when a cycle's inputs are not as many as the assembly's, or the window is empty.
pub fn simulate(
    simulator: &Simulator,
    assembly: &Assembly,
    conditions: &SwarmConditions,
    observe: &mut dyn FnMut(usize),
) -> SwarmTrace {
    let SwarmConditions { inputs, window, poses } = conditions;
    let mut swarm = LiveSwarm::new(simulator, assembly, inputs.len(), *window, *poses);
    for (cycle, inputs) in inputs.iter().enumerate() {
        if swarm.step(inputs).is_err() {
            break;
        }
        observe(cycle + 1);
    }
    swarm.into_trace()
}
