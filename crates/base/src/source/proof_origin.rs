//! What the proof of a circuit from another tool's file begins with.

use std::fmt;

use super::verilog::{SecondReading, VerilogModules};

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ForeignCircuit {
    pub file: String,
    pub circuit: String,
    pub origin: ProofOrigin,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ProofOrigin {
    File,
    /// The netlist that slang made of a Verilog file, in Yosys.
    Slang {
        version: String,
        second: SecondReading,
    },
}

impl VerilogModules {
    pub fn origin(&self, module: usize) -> ProofOrigin {
        ProofOrigin::Slang { version: self.version.clone(), second: self.modules[module].second }
    }
}

impl fmt::Display for ProofOrigin {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self::Slang { second, .. } = self else { return formatter.write_str("the file") };
        match second {
            SecondReading::Alike => formatter.write_str("the file, read alike by slang and by yosys"),
            SecondReading::Equal(steps) => {
                let steps = grouped(*steps as u64);
                write!(formatter, "slang's reading of the file, equal to yosys' in {steps} random steps")
            }
            SecondReading::Different => {
                formatter.write_str("slang's reading of the file, which yosys reads differently")
            }
            SecondReading::NoSteps => {
                formatter.write_str("slang's reading of the file, not compared with yosys': it has feedback")
            }
            SecondReading::None => formatter.write_str("slang's reading of the file, which yosys cannot read"),
        }
    }
}

pub fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let groups = digits.as_bytes().rchunks(3).rev().map(|group| String::from_utf8_lossy(group));
    groups.collect::<Vec<_>>().join(",")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_origin_says_what_was_compared() {
        let slang = |second| ProofOrigin::Slang { version: "0.70".to_owned(), second }.to_string();
        assert_eq!(ProofOrigin::File.to_string(), "the file");
        assert_eq!(slang(SecondReading::Alike), "the file, read alike by slang and by yosys");
        let steps = "slang's reading of the file, equal to yosys' in 4,096 random steps";
        assert_eq!(slang(SecondReading::Equal(4096)), steps);
    }
}
