//! A list of tests and simulations, and the results of running it.

use nbc_base::diag::Diagnostics;
use nbc_base::model::{CircuitTest, Instance, Program, Simulation, Stimulation};
use nbc_circuit::is_same_instance;
use nbc_swarm::RobotFault;

use crate::checked::Checked;
use crate::choice::Choice;
use crate::report;
use crate::simulation::SimulationRun;
use crate::test::TestRun;

/// Tests and simulations to run, in this order.
#[derive(Clone, Debug, Default)]
pub struct RunList<'a> {
    pub tests: Vec<&'a CircuitTest>,
    pub simulations: Vec<&'a Simulation>,
}

impl<'a> RunList<'a> {
    pub fn all(program: &'a Program) -> Self {
        Self { tests: program.tests.iter().collect(), simulations: program.simulations.iter().collect() }
    }

    pub fn chosen(checked: &'a Checked, only: Option<&'a str>, choice: &Choice) -> Result<Self, Diagnostics> {
        let chosen = if *choice == Choice::default() { None } else { Some(checked.circuit(choice)?) };
        let is_chosen = |circuit: &Instance| {
            chosen.as_ref().is_none_or(|chosen| is_same_instance(&checked.program, chosen, circuit))
        };
        let mut list = match only {
            Some(name) => {
                Self { tests: checked.tests(name).collect(), simulations: checked.simulations(name).collect() }
            }
            None => Self::all(&checked.program),
        };
        list.tests.retain(|test| is_chosen(&test.circuit));
        list.simulations.retain(|simulation| {
            is_chosen(&simulation.circuit) && choice.swarm.as_ref().is_none_or(|name| *name == simulation.swarm)
        });
        Ok(list)
    }

    /// Without tests for ever, which are decided at the level of logic alone.
    #[must_use]
    pub fn in_physics(mut self) -> Self {
        self.tests.retain(|test| !matches!(test.stimulation, Stimulation::Ever { .. }));
        self
    }

    pub fn len(&self) -> usize {
        self.tests.len() + self.simulations.len()
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Results of tests and simulations. One that was cancelled has the results so far.
#[derive(Clone, Debug, Default)]
pub struct RunReport {
    pub tests: Vec<TestRun>,
    pub simulations: Vec<SimulationRun>,
    pub left: usize,
}

impl RunReport {
    pub fn passed(&self) -> bool {
        self.tests.iter().all(|test| test.verdict.passed) && self.simulations.iter().all(SimulationRun::passed)
    }

    pub fn fault(&self) -> Option<&RobotFault> {
        let mut rows = self.tests.iter().flat_map(|test| &test.verdict.rows);
        rows.find_map(|row| row.fault.as_ref())
            .or_else(|| self.simulations.iter().find_map(|simulation| simulation.result.fault.as_ref()))
    }

    /// Panics with the tables of the tests and simulations that failed.
    pub fn assert_passed(&self) {
        let tests = self.tests.iter().filter(|test| !test.verdict.passed);
        let simulations = self.simulations.iter().filter(|run| !run.passed());
        let tables = tests.map(|test| report::describe_test(&test.verdict));
        let tables: String = tables.chain(simulations.map(|run| report::describe_simulation(&run.result))).collect();
        assert!(tables.is_empty(), "tests of the swarm failed\n{tables}");
    }
}
