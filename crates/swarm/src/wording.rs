//! Errors of the assembly of swarms, and their messages.

use std::error::Error;
use std::fmt;

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
