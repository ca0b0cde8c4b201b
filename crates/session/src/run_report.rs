//! A list of tests and simulations, and the results of running it.

use nbc_base::model::{CircuitTest, Program, Simulation};
use nbc_swarm::RobotFault;

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
    /// Each once for each swarm of its circuit.
    pub tests: Vec<TestRun>,
    pub simulations: Vec<SimulationRun>,
    /// Tests and simulations that were cancelled or not begun.
    pub left: usize,
}

impl RunReport {
    /// Whether every test passed, and no robot of a simulation failed.
    pub fn passed(&self) -> bool {
        self.tests.iter().all(|test| test.verdict.passed) && self.simulations.iter().all(SimulationRun::passed)
    }

    pub fn fault(&self) -> Option<&RobotFault> {
        let tests = self.tests.iter().find_map(|test| test.verdict.fault());
        tests.or_else(|| self.simulations.iter().find_map(|simulation| simulation.result.fault.as_ref()))
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
