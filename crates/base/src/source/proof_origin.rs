//! What the proof of a circuit from another tool's file begins with.

use std::fmt;

use super::verilog::{Simulated, VerilogModules};

/// A circuit of another tool's file that a program uses, and what its proof begins with.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ForeignCircuit {
    /// The file, or several of one design.
    pub file: String,
    /// The name of the circuit.
    pub circuit: String,
    /// What its proof begins with.
    pub origin: ProofOrigin,
}

/// What a proof begins with: a file, or what a translator made of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ProofOrigin {
    /// The file itself.
    File,
    /// The netlist that Yosys made of the file.
    Yosys {
        /// The version of Yosys.
        version: String,
        /// What a simulation of the file beside the netlist has shown.
        simulated: Simulated,
    },
}

impl VerilogModules {
    /// What a proof of one of the modules begins with.
    pub fn origin(&self, module: &str) -> ProofOrigin {
        let simulated = self.simulated.get(module).copied().unwrap_or(Simulated::NotComparable);
        ProofOrigin::Yosys { version: self.yosys.clone(), simulated }
    }
}

impl fmt::Display for ProofOrigin {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self::Yosys { simulated, .. } = self else { return formatter.write_str("the file") };
        match (simulated, simulated.why_not()) {
            (_, Some(why)) => write!(formatter, "yosys' netlist, which was not simulated: {why}"),
            (Simulated::Equal { steps }, _) => {
                write!(formatter, "yosys' netlist, {} steps equal in iverilog", grouped(*steps))
            }
            _ => formatter.write_str("yosys' netlist"),
        }
    }
}

impl Simulated {
    /// Why nothing was compared, if so.
    pub fn why_not(self) -> Option<&'static str> {
        match self {
            Self::Equal { .. } => None,
            Self::NoSimulator => Some("iverilog is not installed"),
            Self::NotRun => Some("iverilog cannot read it or takes too long"),
            Self::NotComparable => Some("it has feedback, registers that clock each other, or nothing defined"),
        }
    }
}

/// A number with commas, such as 4,096.
fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let groups = digits.as_bytes().rchunks(3).rev().map(|group| String::from_utf8_lossy(group));
    groups.collect::<Vec<_>>().join(",")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_origin_says_what_was_compared() {
        let yosys = |simulated| ProofOrigin::Yosys { version: "0.23".to_owned(), simulated }.to_string();
        assert_eq!(ProofOrigin::File.to_string(), "the file");
        assert_eq!(yosys(Simulated::Equal { steps: 4096 }), "yosys' netlist, 4,096 steps equal in iverilog");
        assert_eq!(yosys(Simulated::Equal { steps: 12 }), "yosys' netlist, 12 steps equal in iverilog");
        let without = "yosys' netlist, which was not simulated: iverilog is not installed";
        assert_eq!(yosys(Simulated::NoSimulator), without);
    }
}
