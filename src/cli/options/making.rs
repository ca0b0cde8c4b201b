//! How a circuit of a program becomes a swarm: the arguments of every command that makes swarms.

use clap::Args;

use crate::cli::options::circuit::{CircuitArguments, RunsArguments};
use crate::cli::options::mapping::GoalArguments;
use crate::cli::options::robots::RobotsArguments;
use crate::cli::{Failure, robots};
use nbc_session::{Choice, CompileOptions};

#[derive(Args)]
pub(in crate::cli) struct MakingArguments {
    #[command(flatten)]
    circuit: CircuitArguments,
    #[command(flatten)]
    library: RobotsArguments,
    #[command(flatten)]
    goal: GoalArguments,
    #[command(flatten)]
    runs: RunsArguments,
}

impl MakingArguments {
    pub(in crate::cli) fn choice(&self) -> Choice {
        self.circuit.choice()
    }

    pub(in crate::cli) fn options(&self) -> Result<CompileOptions, Failure> {
        let robots = self.library.library.as_deref().map(robots::robots_of).transpose()?;
        let options = CompileOptions { robots, swarm: self.choice().swarm, ..self.runs.options() };
        Ok(self.goal.with(options))
    }

    pub(in crate::cli) fn library(&self) -> &RobotsArguments {
        &self.library
    }

    pub(in crate::cli) fn goal(&self) -> &GoalArguments {
        &self.goal
    }
}
