//! The fault that ends a swarm: which robot's simulation failed, and when.

use serde::Serialize;

use nbc_base::model::FaultKind;

/// The robot of a swarm whose simulation failed first. The swarm has no outputs from its cycle on.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct RobotFault {
    pub net: String,
    pub robot: String,
    /// The cycle, from 0 at the start.
    pub cycle: usize,
    /// The env step that was abandoned, from 1 at the start.
    pub env_step: u32,
    pub kind: FaultKind,
}
