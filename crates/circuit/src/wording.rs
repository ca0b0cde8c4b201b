//! What can be wrong with netlists, their mapping and its proof, as data, and how it is worded.

use std::fmt;

use crate::netlist::Netlist;
use crate::storage::WhyUnphased;
use nbc_base::diag::suggest::alternatives;
use nbc_base::model::Function;

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NetlistError {
    Undriven(String),
    WireLoop(String),
}

impl fmt::Display for NetlistError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Undriven(net) => write!(f, "`{net}` has no driver"),
            Self::WireLoop(net) => write!(f, "`{net}` is driven only by itself"),
        }
    }
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MapError {
    Netlist(NetlistError),
    TooLarge {
        cells: usize,
        most: u64,
    },
    Incomplete {
        missing: Function,
        known: Vec<Function>,
        /// The functions each of which alone would complete the library; empty if there is none.
        completions: Vec<Function>,
    },
}

impl From<NetlistError> for MapError {
    fn from(error: NetlistError) -> Self {
        Self::Netlist(error)
    }
}

impl fmt::Display for MapError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Netlist(error) => error.fmt(f),
            Self::TooLarge { cells, most } => write!(f, "the circuit has {cells} cells, expected at most {most}"),
            Self::Incomplete { missing, known, .. } if known.is_empty() => {
                write!(f, "`{}` cannot be made without cells", missing.name())
            }
            Self::Incomplete { missing, known, .. } => {
                write!(f, "`{}` cannot be made of {}", missing.name(), alternatives(&names(known), "and"))
            }
        }
    }
}

impl MapError {
    pub fn help(&self) -> Option<String> {
        let Self::Incomplete { completions, .. } = self else {
            return None;
        };
        Some(match completions[..] {
            [] => "`nand` alone makes a library complete".to_owned(),
            _ => format!("any one of {} would complete the library", alternatives(&names(completions), "or")),
        })
    }
}

fn names(functions: &[Function]) -> Vec<&'static str> {
    functions.iter().map(|function| function.name()).collect()
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ProofError {
    Netlist(NetlistError),
    Port(String),
    NewLoop(String),
    Start(String),
    Different {
        /// The output port, or the net on a loop whose next state differs.
        output: String,
        inputs: Vec<(String, bool)>,
    },
}

impl From<NetlistError> for ProofError {
    fn from(error: NetlistError) -> Self {
        Self::Netlist(error)
    }
}

impl fmt::Display for ProofError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Netlist(error) => error.fmt(f),
            Self::Port(port) => write!(f, "`{port}` is a port of only one of the netlists"),
            Self::Start(net) => write!(f, "`{net}` starts or changes otherwise"),
            Self::NewLoop(net) => write!(f, "`{net}` is on a loop that the source does not have"),
            Self::Different { output, inputs } => {
                let values = inputs.iter().map(|(name, value)| format!("{name}={}", u8::from(*value)));
                write!(f, "`{output}` differs at {}", values.collect::<Vec<_>>().join(" "))
            }
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Oscillation;

impl fmt::Display for Oscillation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the circuit does not settle")
    }
}

impl WhyUnphased {
    pub fn explain(self, netlist: &Netlist) -> String {
        match self {
            Self::NoEnable => "no net closes it".to_owned(),
            Self::Race => "its state depends on delays when it closes".to_owned(),
            Self::Glitch(cell) => format!("`{}` may glitch while it is closed", netlist.net_name(cell)),
            Self::ManyInputs => "it has too many inputs to try all their values".to_owned(),
            Self::ManyEnables => "the circuit has too many enables to try all their values".to_owned(),
            Self::StaysOpen => "a loop passes it while it is open".to_owned(),
        }
    }
}
