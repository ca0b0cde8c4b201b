//! A whole file at once: every test and every simulation in physics.

use std::path::Path;

use crate::diag::{Diagnostic, render};
use crate::pipeline::{Loaded, Options, SimulationRun, TestRun, cases, load, run_simulation};
use crate::report;
use crate::store::DiskWorld;
use crate::swarm::Level;

/// What came of a file's tests and simulations.
#[derive(Clone, Debug)]
pub struct RunReport {
    /// The tests in order, each once for each swarm of its circuit.
    pub tests: Vec<TestRun>,
    /// The simulations in order.
    pub simulations: Vec<SimulationRun>,
}

/// Why a file could not be run: its diagnostics as text.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct RunError(String);

/// Reads, checks, compiles, simulates and tests a file of the disk.
///
/// # Errors
/// When the file has errors or its circuits cannot be built; a test that fails is no error.
pub fn run_file(path: impl AsRef<Path>, options: &Options) -> Result<RunReport, RunError> {
    let Loaded { sources, checked, .. } = load(&DiskWorld, &path.as_ref().to_string_lossy());
    let fail = |diagnostics: Vec<Diagnostic>| RunError(render::text(&diagnostics, &sources, false));
    if checked.has_errors() {
        return Err(fail(checked.diagnostics));
    }
    let program = &checked.program;
    let mut report = RunReport { tests: Vec::new(), simulations: Vec::new() };
    for test in &program.tests {
        let cases = cases(program, test, Some(Level::Physics), options).map_err(fail)?;
        report.tests.extend(cases.into_iter().map(|case| case.run(options, &mut |_| {})));
    }
    for simulation in &program.simulations {
        report.simulations.push(run_simulation(program, simulation, options, &mut |_, _| {}).map_err(fail)?);
    }
    Ok(report)
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
