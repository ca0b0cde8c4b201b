//! Why the reachable states of a design are not used.

use std::fmt;

/// Why the reachable states of a design are not used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum WhyEveryState {
    /// It has no registers.
    NoRegisters,
    /// A register that is not a flip-flop.
    Latch(String),
    /// A register with an asynchronous set or reset.
    Forced(String),
    /// The logic has feedback.
    Loop,
}

impl fmt::Display for WhyEveryState {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoRegisters => f.write_str("the design has no registers"),
            Self::Latch(name) => write!(f, "`{name}` is a level-sensitive latch"),
            Self::Forced(name) => write!(f, "`{name}` has an asynchronous set or reset"),
            Self::Loop => f.write_str("the logic has feedback"),
        }
    }
}
