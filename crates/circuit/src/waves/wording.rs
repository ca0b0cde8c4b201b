//! Why a circuit cannot be a wave machine, as data, and how it is worded.

use std::error::Error;
use std::fmt;

use crate::{MapError, NetlistError};
use nbc_base::diag::counted;

/// Why a circuit cannot be a wave machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum WaveError {
    /// The netlist is not well formed.
    Netlist(NetlistError),
    /// The library cannot make the circuit's logic.
    Unmapped(MapError),
    /// The library has no robot that delays a net.
    NoBuffer,
    /// A loop that is no register.
    Loop {
        /// A net of it.
        net: String,
    },
    /// A latch that is not half of a register.
    Latch {
        /// A net of it.
        net: String,
    },
    /// A register whose clock is a net inside the circuit.
    GatedClock {
        /// The register.
        net: String,
        /// Its clock.
        clock: String,
    },
    /// Registers of two clocks.
    TwoClocks {
        /// A register of each.
        nets: [String; 2],
        /// The clocks.
        clocks: [String; 2],
    },
    /// Registers that take their data at different edges.
    BothEdges {
        /// One that takes them when the clock rises.
        rising: String,
        /// One that takes them when it falls.
        falling: String,
    },
    /// The clock drives something else than registers.
    ClockIsRead {
        /// The clock.
        clock: String,
    },
    /// A register whose cells have start values that contradict each other.
    Starts {
        /// The register.
        net: String,
    },
    /// The requested step is no whole number of beats.
    UnevenStep {
        /// The requested cycles.
        wanted: u32,
        /// Cycles of a beat.
        beat: u32,
    },
    /// The requested step is too short.
    ShortStep {
        /// The requested cycles.
        wanted: u32,
        /// The fewest cycles.
        least: u32,
    },
}

impl From<MapError> for WaveError {
    fn from(error: MapError) -> Self {
        Self::Unmapped(error)
    }
}

impl fmt::Display for WaveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Netlist(error) => error.fmt(f),
            Self::Unmapped(error) => error.fmt(f),
            Self::NoBuffer => f.write_str("no robot of the library delays a net"),
            Self::Loop { net } => write!(f, "the loop through `{net}` has no register"),
            Self::Latch { net } => write!(f, "`{net}` is a latch, not a register"),
            Self::GatedClock { net, clock } => write!(f, "the clock of `{net}` is `{clock}`, which is not an input"),
            Self::TwoClocks { nets: [one, two], clocks: [a, b] } => {
                write!(f, "the registers have two clocks: `{a}` for `{one}` and `{b}` for `{two}`")
            }
            Self::BothEdges { rising, falling } => {
                write!(f, "`{rising}` changes when the clock rises, but `{falling}` when it falls")
            }
            Self::ClockIsRead { clock } => write!(f, "the clock `{clock}` is also read as data"),
            Self::Starts { net } => write!(f, "the cells of the register `{net}` have start values that contradict"),
            Self::UnevenStep { wanted, beat } => {
                let [wanted, beat] = [*wanted, *beat].map(|cycles| counted(cycles as usize, "cycle"));
                write!(f, "a step of {wanted} is no whole number of beats of {beat}")
            }
            Self::ShortStep { wanted, least } => {
                write!(f, "a step of {} is too short, expected at least {least}", counted(*wanted as usize, "cycle"))
            }
        }
    }
}

impl Error for WaveError {}

impl WaveError {
    /// What to do about it.
    pub fn help(&self) -> Option<String> {
        Some(match self {
            Self::Netlist(_) => return None,
            Self::Unmapped(error) => return error.help(),
            Self::NoBuffer => "a `buf`, `and` or `or` robot that is quick enough for the beat suffices".to_owned(),
            Self::Loop { .. } | Self::Latch { .. } => {
                "in a wave machine every loop passes a `register`; `registers: pulsed` allows latches".to_owned()
            }
            Self::GatedClock { .. } => {
                "let every register change in each step, and keep a value with `if enable then new else old`".to_owned()
            }
            Self::TwoClocks { .. } => "give all registers one clock".to_owned(),
            Self::BothEdges { .. } => "let all registers change at the same edge".to_owned(),
            Self::ClockIsRead { .. } => "in a wave machine the clock is no stimulus: read another input".to_owned(),
            Self::Starts { .. } => {
                "give only one cell of each latch a start value, the same in both latches".to_owned()
            }
            Self::UnevenStep { .. } => "make `step` a multiple of `beat`".to_owned(),
            Self::ShortStep { .. } => "leave out `step` for the shortest one".to_owned(),
        })
    }
}

/// Why a wave machine is not proved to make the steps of its source.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CertifyError {
    /// The phase of a net does not fit that of its driver, so machines would mix.
    Mixed {
        /// The net.
        net: String,
    },
    /// A pin reads a state that the source does not have.
    NoState {
        /// The net of its cell.
        net: String,
    },
    /// A pin or a bit of the state starts with other values.
    Start {
        /// The net.
        net: String,
    },
    /// An output or the next value of a bit differs.
    Different {
        /// The net.
        net: String,
    },
}

impl fmt::Display for CertifyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Mixed { net } => write!(f, "the phase of `{net}` does not fit its driver"),
            Self::NoState { net } => write!(f, "`{net}` reads a state that the source does not have"),
            Self::Start { net } => write!(f, "`{net}` has other start values"),
            Self::Different { net } => write!(f, "`{net}` differs"),
        }
    }
}

impl Error for CertifyError {}
