//! Why a circuit has no steps in which a property could hold, in words.

use std::fmt;

use crate::waves::WaveError;

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoSteps {
    /// It has memory that is no register of one clock, and is too large for other steps.
    Memory(WaveError),
    /// It has feedback that does not settle for some inputs.
    Unsettled { most: usize },
    /// It has another clock than the circuit that it is compared with, or has none and reads that clock.
    OtherSteps,
    /// A property reads the clock.
    ClockHasNoValue { clock: String },
    /// Its environment takes steps when a clock rises, and the circuit does not.
    EnvironmentClock,
    /// What the circuit and its environment answer each other depends on itself.
    Circle,
    /// Nobody waits for the answer any more.
    Cancelled,
}

impl fmt::Display for NoSteps {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Memory(why) => why.fmt(f),
            Self::Unsettled { most } => {
                write!(f, "from some settled state and for some inputs, it does not settle within {most} time steps")
            }
            Self::OtherSteps => f.write_str("its steps are not the edges of the same clock"),
            Self::ClockHasNoValue { clock } => {
                write!(f, "a property cannot read the clock `{clock}`: each step after the first is an edge of it")
            }
            Self::EnvironmentClock => f.write_str(
                "its environment has steps when a clock rises, and the circuit has no registers of that clock",
            ),
            Self::Circle => f.write_str("what it and its environment answer each other depends on itself"),
            Self::Cancelled => f.write_str("the check was cancelled"),
        }
    }
}
