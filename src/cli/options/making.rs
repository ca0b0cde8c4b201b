//! How a circuit of a program becomes a swarm: the arguments of every command that makes swarms.

use clap::Args;

use crate::cli::options::mapping::GoalArguments;
use crate::cli::options::robots::RobotsArguments;
use crate::cli::{Failure, robots};
use nbc_session::{Choice, CompileOptions, RUNS};

#[derive(Args)]
pub(in crate::cli) struct MakingArguments {
    /// The circuit, with parameters such as `adder[8]` or `adder[n = 8]` [default: the last one in the file, or all
    /// that are tested]
    #[arg(long, value_name = "NAME")]
    circuit: Option<String>,
    /// The swarm, if several are declared for the circuit; tests run once for each unless one is named
    #[arg(long, value_name = "NAME")]
    swarm: Option<String>,
    #[command(flatten)]
    pub(in crate::cli) library: RobotsArguments,
    #[command(flatten)]
    pub(in crate::cli) goal: GoalArguments,
    /// The folder of evolution runs; `library { from: NAME }` reads robots from `NAME/robots` in it
    #[arg(long, value_name = "DIR", default_value = RUNS)]
    runs: String,
}

impl MakingArguments {
    pub(in crate::cli) fn choice(&self) -> Choice {
        Choice { circuit: self.circuit.clone(), swarm: self.swarm.clone() }
    }

    pub(in crate::cli) fn options(&self) -> Result<CompileOptions, Failure> {
        Ok(CompileOptions {
            robots: self.library.library.as_deref().map(robots::robots_of).transpose()?,
            swarm: self.swarm.clone(),
            objective: self.goal.objective(),
            effort: self.goal.effort(),
            runs: self.runs.clone(),
            ..CompileOptions::default()
        })
    }
}
