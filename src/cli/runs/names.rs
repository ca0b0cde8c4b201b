//! The names by which users choose tests and simulations.

use std::collections::BTreeSet;

use crate::cli::runs::wording;
use nbc_base::diag::Diagnostic;
use nbc_session::Checked;

pub(in crate::cli) fn unknown_run(file: &Checked, name: &str) -> Diagnostic {
    let mut known = names_of_tests(file);
    known.extend(file.program.simulations.iter().map(|simulation| simulation.swarm.clone()));
    wording::unknown_run(&file.path, name, &known.into_iter().collect::<Vec<_>>())
}

pub(in crate::cli) fn names_of_tests(file: &Checked) -> BTreeSet<String> {
    let tests = &file.program.tests;
    let titles = tests.iter().map(|test| test.title.clone()).filter(|title| !title.is_empty());
    tests.iter().map(|test| test.circuit.to_string()).chain(titles).collect()
}
