//! Errors of the assembly of swarms, faults of their robots, and their messages.

use std::error::Error;
use std::fmt;

use crate::RobotFault;
use nbc_base::model::Function;

/// A netlist for which a library lacks robots.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum AssembleError {
    /// No robot computes a cell's function.
    MissingFunction {
        /// What the cell computes.
        function: Function,
    },
}

impl fmt::Display for AssembleError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::MissingFunction { function } => write!(f, "the library has no robot for `{function}`"),
        }
    }
}

impl Error for AssembleError {}

impl fmt::Display for RobotFault {
    /// `robot nand_5x5 on net q became unstable in cycle 3`
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { net, robot, cycle, kind, .. } = self;
        write!(f, "robot {robot} on net {net} {kind} in cycle {}", cycle + 1)
    }
}

impl Error for RobotFault {}
