//! Why a circuit cannot be a wave machine, as data, and how it is worded.

use std::fmt;

use crate::{MapError, NetlistError};
use nbc_base::diag::counted;

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum WaveError {
    Netlist(NetlistError),
    Unmapped(MapError),
    NoBuffer,
    Loop { net: String },
    Latch { net: String },
    Forced { net: String },
    GatedClock { net: String, clock: String },
    TwoClocks { nets: [String; 2], clocks: [String; 2] },
    BothEdges { rising: String, falling: String },
    ClockIsRead { clock: String },
    Starts { net: String },
    UnevenStep { wanted: u32, beat: u32 },
    ShortStep { wanted: u32, least: u32 },
}

impl fmt::Display for WaveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Netlist(error) => error.fmt(f),
            Self::Unmapped(error) => error.fmt(f),
            Self::NoBuffer => f.write_str("no robot of the library delays a net"),
            Self::Loop { net } => write!(f, "the loop through `{net}` has no register"),
            Self::Latch { net } => write!(f, "`{net}` is a latch, not a register"),
            Self::Forced { net } => write!(f, "`{net}` is set or reset without its clock"),
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

impl WaveError {
    pub fn help(&self) -> Option<String> {
        Some(match self {
            Self::Netlist(_) => return None,
            Self::Unmapped(error) => return error.help(),
            Self::NoBuffer => "a `buf`, `and` or `or` robot that is quick enough for the beat suffices".to_owned(),
            Self::Loop { .. } | Self::Latch { .. } => {
                "in a wave machine every loop passes a `register`; `registers: mux` allows latches".to_owned()
            }
            Self::Forced { .. } => "let the clock reset it, with the operand `reset` of `register`".to_owned(),
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

pub(super) fn is_mixed(net: &str) -> String {
    format!("the phase of `{net}` does not fit its driver")
}

pub(super) fn reads_no_state(net: &str) -> String {
    format!("`{net}` reads a state that the source does not have")
}

pub(super) fn has_other_starts(net: &str) -> String {
    format!("`{net}` has other start values")
}

pub(super) fn is_different(net: &str) -> String {
    format!("`{net}` differs")
}
