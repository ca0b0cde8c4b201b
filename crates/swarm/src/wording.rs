//! The fault that ends a swarm, and its message.

use std::error::Error;
use std::fmt;

use serde::Serialize;

use nbc_base::model::FaultKind;

/// The robot of a swarm whose simulation failed first. The swarm has no outputs from its cycle on.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RobotFault {
    pub net: String,
    pub robot: String,
    /// The cycle, from 0 at the start.
    pub cycle: usize,
    /// The env step that was abandoned, from 1 at the start.
    pub env_step: u32,
    pub kind: FaultKind,
}

impl fmt::Display for RobotFault {
    /// `robot nand_5x5 on net q became unstable in cycle 3`
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { net, robot, cycle, kind, .. } = self;
        write!(f, "robot {robot} on net {net} {kind} in cycle {}", cycle + 1)
    }
}

impl Error for RobotFault {}
