//! Arguments that choose a circuit of a source file, and the place of evolution runs.

use clap::Args;

use nbc_session::{Choice, CompileOptions, RUNS};

/// The choice of a circuit in a file.
#[derive(Args)]
pub(in crate::cli) struct CircuitArguments {
    /// The circuit, with parameters such as `adder[8]` or `adder[n = 8]` [default: the last one in the file]
    #[arg(long, value_name = "NAME")]
    circuit: Option<String>,
    /// The swarm, if several are declared for the circuit
    #[arg(long, value_name = "NAME")]
    swarm: Option<String>,
}

impl CircuitArguments {
    pub(in crate::cli) fn choice(&self) -> Choice {
        Choice { circuit: self.circuit.clone(), swarm: self.swarm.clone() }
    }
}

/// The place of evolution runs.
#[derive(Args)]
pub(in crate::cli) struct RunsArguments {
    /// The folder of evolution runs; `library { from: NAME }` reads robots from `NAME/robots` in it
    #[arg(long, value_name = "DIR", default_value = RUNS)]
    runs: String,
}

impl RunsArguments {
    pub(in crate::cli) fn options(&self) -> CompileOptions {
        CompileOptions { runs: self.runs.clone(), ..CompileOptions::default() }
    }
}
