//! The results of a whole file.

use crate::report;
use crate::simulation::SimulationRun;
use crate::test::TestRun;

/// The results of a file's tests and simulations.
#[derive(Clone, Debug)]
pub struct RunReport {
    /// The tests in order, each once for each swarm of its circuit.
    pub tests: Vec<TestRun>,
    /// The simulations in order.
    pub simulations: Vec<SimulationRun>,
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
