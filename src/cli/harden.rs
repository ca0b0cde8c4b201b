//! Hardening: leaves out the robots that fail first in other worlds, until the tests of a circuit pass in enough of
//! them.

use clap::Args;
use serde::Serialize;

use crate::cli::options::number::number;
use crate::cli::test::share;
use crate::cli::wording::{HardenNote, UsageError};
use crate::cli::world_runs::{Experiment, WorldRuns};
use crate::cli::{Context, Failure, Interrupt};
use nbc_base::model::{CircuitTest, Instance, Variation};
use nbc_circuit::is_same_instance;
use nbc_session::{Checked, CompileOptions, Session, TestCase, TestOptions};
use nbc_swarm::{Level, Proportion, Robustness};

/// The worlds in which the tests of a circuit must pass.
#[derive(Args)]
pub(super) struct HardenArguments {
    /// Leave out the robots that fail first in worlds that differ by so much, such as `20%` or `friction=30%`, until
    /// the tests of the circuit pass in enough of them
    #[arg(long, value_name = "CHANGES", conflicts_with = "cells", value_parser = changes)]
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

/// The robots that were left out, and how that was found.
#[derive(Clone, Debug, Default, Serialize)]
pub(super) struct Hardened {
    /// The names of the robots that are left out.
    pub without: Vec<String>,
    /// Whether the tests pass in enough worlds.
    pub reached: bool,
    /// What was tried, in order.
    pub tried: Vec<HardeningStep>,
}

/// A choice of robots and its yield.
#[derive(Clone, Debug, Serialize)]
pub(super) struct HardeningStep {
    /// The robots that are left out.
    pub without: Vec<String>,
    /// The number of robots of the largest swarm.
    pub robots: usize,
    /// The smallest yield of the tests.
    #[serde(rename = "yield")]
    pub passed: Proportion,
    /// The robots that fail first in some worlds, those of most worlds first.
    pub fails_first: Vec<String>,
}

impl HardenArguments {
    /// Finds the robots to leave out of the swarm of a circuit; nothing if hardening is not asked for, and `None` after
    /// an interruption.
    ///
    /// # Errors
    /// When the circuit has no test or cannot be compiled.
    pub(super) fn find(
        &self,
        session: &Session,
        checked: &Checked,
        circuit: &Instance,
        options: &CompileOptions,
        context: &Context,
    ) -> Result<Option<Hardened>, Failure> {
        let Some(variation) = self.harden else { return Ok(Some(Hardened::default())) };
        let tests =
            checked.program.tests.iter().filter(|test| is_same_instance(&checked.program, &test.circuit, circuit));
        let tests: Vec<&CircuitTest> = tests.collect();
        if tests.is_empty() {
            return Err(UsageError::NoTest { circuit: circuit.to_string() }.into());
        }
        let interrupt = Interrupt::watch()?;
        let runs = WorldRuns { session, interrupt: &interrupt, worlds: self.worlds as usize, seed: self.seed };
        let mut hardened = Hardened::default();
        // Robots without which the circuit cannot be built.
        let mut needed: Vec<String> = Vec::new();
        let mut without: Vec<String> = Vec::new();
        loop {
            let compile = CompileOptions { without: without.clone(), cancel: interrupt.cancel(), ..options.clone() };
            let options = TestOptions { level: Some(Level::Physics), compile };
            let cases = tests.iter().map(|test| session.cases(checked, test, &options)).collect::<Result<Vec<_>, _>>();
            match (cases, without.pop()) {
                (Err(faults), None) => return Err(faults.into()),
                (Err(_), Some(last)) => needed.push(last),
                (Ok(cases), last) => {
                    without.extend(last);
                    let cases: Vec<TestCase<'_>> = cases.into_iter().flatten().collect();
                    let experiments: Vec<Experiment<'_, '_>> =
                        cases.iter().map(|case| Experiment { case, variation, scale: 1.0 }).collect();
                    let found = runs.run(&experiments, |_| Ok(()))?;
                    if found.len() < experiments.len() {
                        return Ok(None);
                    }
                    let step = HardeningStep::of(&found, without.clone());
                    context.log(&format!("{}\n", step.note().text()));
                    hardened.tried.push(step);
                }
            }
            let step = hardened.tried.last().expect("the first choice of robots can be built");
            hardened.reached = step.passed.share() >= self.least_yield;
            let next = step.fails_first.iter().find(|name| !needed.contains(name) && !without.contains(name));
            match next.filter(|_| !hardened.reached) {
                Some(next) => without.push(next.clone()),
                None => break,
            }
        }
        hardened.without = hardened.best().without.clone();
        let end = HardenNote::End { without: &hardened.without, reached: hardened.reached };
        context.log(&format!("{}\n", end.text()));
        Ok(Some(hardened))
    }
}

impl Hardened {
    /// The step of the highest yield; of equals, that of the fewest robots.
    fn best(&self) -> &HardeningStep {
        let rank = |step: &HardeningStep| (step.passed.successes, std::cmp::Reverse(step.robots));
        let better = |best, step| if rank(step) > rank(best) { step } else { best };
        self.tried.iter().reduce(better).expect("there is a first step")
    }
}

impl HardeningStep {
    fn note(&self) -> HardenNote<'_> {
        let Proportion { successes: passed, attempts: worlds } = self.passed;
        HardenNote::Step { without: &self.without, robots: self.robots, passed, worlds }
    }

    fn of(found: &[Robustness], without: Vec<String>) -> Self {
        let least = found.iter().map(|one| one.passed).min_by(|a, b| a.share().total_cmp(&b.share()));
        let mut failing: Vec<(String, usize)> = Vec::new();
        for robot in found.iter().flat_map(|one| &one.fails_first) {
            match failing.iter_mut().find(|(name, _)| *name == robot.robot) {
                Some((_, worlds)) => *worlds += robot.worlds,
                None => failing.push((robot.robot.clone(), robot.worlds)),
            }
        }
        failing.sort_by_key(|(_, worlds)| std::cmp::Reverse(*worlds));
        Self {
            without,
            robots: found.iter().map(|one| one.robots).max().unwrap_or(0),
            passed: least.expect("there is a test"),
            fails_first: failing.into_iter().map(|(name, _)| name).collect(),
        }
    }
}

/// Changes of the world; a share alone is that of all factors.
fn changes(text: &str) -> Result<Variation, String> {
    let all = text.ends_with('%') && !text.contains('=');
    if all { format!("all={text}").parse() } else { text.parse() }.map_err(|error| format!("{error}"))
}
