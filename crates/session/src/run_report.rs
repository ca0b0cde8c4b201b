//! A list of tests and simulations, and the results of running it.

use nbc_base::model::{CircuitTest, Program, Simulation};

use crate::report;
use crate::simulation::SimulationRun;
use crate::test::TestRun;

/// Tests and simulations to run, in this order.
#[derive(Clone, Debug, Default)]
pub struct RunList<'a> {
    /// The tests.
    pub tests: Vec<&'a CircuitTest>,
    /// The simulations, which come after all tests.
    pub simulations: Vec<&'a Simulation>,
}

impl<'a> RunList<'a> {
    /// All tests and simulations of a program.
    pub fn all(program: &'a Program) -> Self {
        Self { tests: program.tests.iter().collect(), simulations: program.simulations.iter().collect() }
    }

    /// The number of tests and simulations.
    pub fn len(&self) -> usize {
        self.tests.len() + self.simulations.len()
    }

    /// Whether there is nothing to run.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// The results of tests and simulations. One that was cancelled has the results up to then, and its `end` is
/// [`RunEnd::Cancelled`](crate::RunEnd::Cancelled).
#[derive(Clone, Debug, Default)]
pub struct RunReport {
    /// The tests in order, each once for each swarm of its circuit.
    pub tests: Vec<TestRun>,
    /// The simulations in order.
    pub simulations: Vec<SimulationRun>,
    /// The number of tests and simulations that were cancelled or not begun.
    pub left: usize,
}

impl RunReport {
    /// Whether every test passed.
    pub fn passed(&self) -> bool {
        self.tests.iter().all(|test| test.verdict.passed)
    }

    /// Asserts that every test passed.
    ///
    /// # Panics
    /// With the truth tables of the tests that failed.
    pub fn assert_passed(&self) {
        let failed = self.tests.iter().filter(|test| !test.verdict.passed);
        let tables: String = failed.map(|test| report::describe_test(&test.verdict)).collect();
        assert!(tables.is_empty(), "tests of the swarm failed\n{tables}");
    }
}
