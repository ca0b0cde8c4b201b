//! The options of `nbc build` that leave out the robots which fail first in other worlds.

use clap::Args;

use crate::cli::options::number::number;
use crate::cli::test::share;
use crate::cli::world_runs::world_runs;
use crate::cli::{Context, Failure, Interrupt};
use nbc_base::model::{Instance, Variation};
use nbc_session::{Checked, CompileOptions, Hardened, Hardening, Session};

#[derive(Args)]
pub(super) struct HardenArguments {
    /// Leave out the robots that fail first in worlds that differ by so much, such as `20%` or `friction=30%`, until
    /// the tests of the circuit pass in enough of them
    #[arg(long, value_name = "CHANGES", conflicts_with = "cells")]
    harden: Option<Variation>,
    /// The number of worlds
    #[arg(long, value_name = "N", requires = "harden", default_value_t = 40)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    worlds: u32,
    /// The seed of the worlds
    #[arg(long, value_name = "SEED", requires = "harden", default_value_t = 1, value_parser = number::<u64>)]
    seed: u64,
    /// The share of worlds in which each test must pass
    #[arg(long, value_name = "SHARE", requires = "harden", default_value = "95%", value_parser = share)]
    least_yield: f64,
}

impl HardenArguments {
    /// Finds robots to leave out. The list is empty if hardening is not asked for; an interruption returns `None`.
    pub(super) fn find(
        &self,
        session: &Session,
        checked: &Checked,
        circuit: &Instance,
        options: &CompileOptions,
        context: &Context,
    ) -> Result<Option<Hardened>, Failure> {
        let Some(variation) = self.harden else { return Ok(Some(Hardened::default())) };
        let &Self { worlds, seed, least_yield, .. } = self;
        let hardening = Hardening { variation, worlds: worlds as usize, seed, least_yield };
        let interrupt = Interrupt::watch()?;
        let options = CompileOptions { cancel: interrupt.cancel(), ..options.clone() };
        let hardened = session.harden(
            checked,
            circuit,
            &options,
            hardening,
            &mut |yields| world_runs(session, yields, &interrupt, |_| Ok(())),
            &mut |step| context.log(&format!("{step}\n")),
        )?;
        if let Some(hardened) = &hardened {
            context.log(&format!("{hardened}\n"));
        }
        Ok(hardened)
    }
}
