//! The names by which users choose tests and simulations.

use std::collections::BTreeSet;

use crate::cli::runs::wording::RunChoiceError;
use nbc_session::Checked;

/// A name that no test and no simulation of a file has.
pub(in crate::cli) fn unknown_run(file: &Checked, name: &str) -> RunChoiceError {
    let mut known = names_of_tests(file);
    known.extend(file.program.simulations.iter().map(|simulation| simulation.swarm.clone()));
    let known = known.into_iter().collect();
    RunChoiceError::UnknownRun { file: file.path.clone(), name: name.to_owned(), known }
}

/// The circuits and the titles of a file's tests.
pub(in crate::cli) fn names_of_tests(file: &Checked) -> BTreeSet<String> {
    let tests = &file.program.tests;
    let titles = tests.iter().map(|test| test.title.clone()).filter(|title| !title.is_empty());
    tests.iter().map(|test| test.circuit.to_string()).chain(titles).collect()
}
