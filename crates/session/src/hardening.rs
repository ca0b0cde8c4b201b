//! Hardening: leaves out the robots that fail first in other worlds, until the tests of a circuit pass in enough of
//! them.

use std::cmp::Reverse;
use std::fmt;

use serde::Serialize;

use crate::wording;
use crate::{Checked, CompileOptions, Session, TestCase, TestOptions, Yields};
use nbc_base::diag::{Diagnostics, counted};
use nbc_base::model::{CircuitTest, Instance, Stimulation, Variation};
use nbc_circuit::is_same_instance;
use nbc_swarm::{Level, Proportion, Robustness};

/// The worlds in which the tests of a circuit should pass.
#[derive(Clone, Copy, Debug)]
pub struct Hardening {
    pub variation: Variation,
    pub worlds: usize,
    pub seed: u64,
    /// The share of worlds in which each test must pass.
    pub least_yield: f64,
}

/// The robots to leave out, and what was tried.
#[derive(Clone, Debug, Default, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Hardened {
    /// The robots that are left out.
    pub without: Vec<String>,
    /// Whether the tests pass in enough worlds.
    pub reached: bool,
    /// The choices that were tried, in order.
    pub tried: Vec<HardeningStep>,
}

/// A choice of robots and its yield.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct HardeningStep {
    /// The robots that are left out.
    pub without: Vec<String>,
    /// Of the largest swarm.
    pub robots: usize,
    /// The smallest yield of the tests.
    #[serde(rename = "yield")]
    pub passed: Proportion,
    /// Those of most worlds first.
    pub fails_first: Vec<String>,
}

impl Session {
    /// Finds robots to leave out of the swarm of a circuit. `run` returns fewer results than experiments if it was
    /// stopped; `tell` receives each choice of robots. `None` if it was stopped.
    pub fn harden<E: From<Diagnostics>>(
        &self,
        checked: &Checked,
        circuit: &Instance,
        options: &CompileOptions,
        hardening: Hardening,
        run: &mut dyn FnMut(&Yields<'_>) -> Result<Vec<Robustness>, E>,
        tell: &mut dyn FnMut(&HardeningStep),
    ) -> Result<Option<Hardened>, E> {
        let tests =
            checked.program.tests.iter().filter(|test| is_same_instance(&checked.program, &test.circuit, circuit));
        // What holds for ever holds in every world.
        let tests = tests.filter(|test| !matches!(test.stimulation, Stimulation::Ever { .. }));
        let tests: Vec<&CircuitTest> = tests.collect();
        if tests.is_empty() {
            return Err(Diagnostics::from(wording::no_test_to_harden(&circuit.to_string())).into());
        }
        let Hardening { variation, worlds, seed, least_yield } = hardening;
        let mut hardened = Hardened::default();
        // Robots without which the circuit cannot be built.
        let mut needed: Vec<String> = Vec::new();
        let mut without: Vec<String> = Vec::new();
        loop {
            let compile = CompileOptions { without: without.clone(), ..options.clone() };
            let options = TestOptions { level: Some(Level::Physics), compile };
            let cases = tests.iter().map(|test| checked.cases(test, &options)).collect::<Result<Vec<_>, _>>();
            match (cases, without.pop()) {
                (Err(faults), None) => return Err(faults.into()),
                (Err(_), Some(last)) => needed.push(last),
                (Ok(cases), last) => {
                    without.extend(last);
                    let cases: Vec<TestCase> = cases.into_iter().flatten().collect();
                    let found = run(&Yields::of(&cases, &[variation], &[1.0], worlds, seed))?;
                    if found.len() < cases.len() {
                        return Ok(None);
                    }
                    let step = HardeningStep::of(&found, without.clone());
                    tell(&step);
                    hardened.tried.push(step);
                }
            }
            let step = hardened.tried.last().expect("the first choice of robots can be built");
            hardened.reached = step.passed.share() >= least_yield;
            let next = step.fails_first.iter().find(|name| !needed.contains(name) && !without.contains(name));
            match next.filter(|_| !hardened.reached) {
                Some(next) => without.push(next.clone()),
                None => break,
            }
        }
        hardened.without = hardened.best().without.clone();
        Ok(Some(hardened))
    }
}

impl Hardened {
    /// The step of the highest yield; of equals, that of the fewest robots.
    fn best(&self) -> &HardeningStep {
        let rank = |step: &HardeningStep| (step.passed.successes, Reverse(step.robots));
        let better = |best, step| if rank(step) > rank(best) { step } else { best };
        self.tried.iter().reduce(better).expect("there is a first step")
    }
}

impl HardeningStep {
    fn of(found: &[Robustness], without: Vec<String>) -> Self {
        let least = found.iter().map(|one| one.passed).min_by(|a, b| a.share().total_cmp(&b.share()));
        let mut failing: Vec<(String, usize)> = Vec::new();
        for robot in found.iter().flat_map(|one| &one.fails_first) {
            match failing.iter_mut().find(|(name, _)| *name == robot.robot) {
                Some((_, worlds)) => *worlds += robot.worlds,
                None => failing.push((robot.robot.clone(), robot.worlds)),
            }
        }
        failing.sort_by_key(|(_, worlds)| Reverse(*worlds));
        Self {
            without,
            robots: found.iter().map(|one| one.robots).max().unwrap_or(0),
            passed: least.expect("there is a test"),
            fails_first: failing.into_iter().map(|(name, _)| name).collect(),
        }
    }
}

impl fmt::Display for HardeningStep {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let robots = counted(self.robots, "robot");
        let Proportion { successes, attempts } = self.passed;
        let choice = match &self.without[..] {
            [] => "all robots of the library".to_owned(),
            without => format!("without {}", without.join(", ")),
        };
        write!(f, "{choice}: {robots}, {successes} of {} pass", counted(attempts, "world"))
    }
}

impl fmt::Display for Hardened {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.reached {
            f.write_str("no choice of robots passes in enough worlds; ")?;
        }
        match &self.without[..] {
            [] => f.write_str("no robot is left out"),
            without => write!(f, "to use these robots, write `without: [{}]` in the library", without.join(", ")),
        }
    }
}
