//! The names by which users choose tests and simulations.

use std::collections::BTreeSet;

use crate::cli::Failure;
use crate::cli::runs::wording::RunChoiceError;
use nbc_base::model::Instance;
use nbc_circuit::is_same_instance;
use nbc_session::{Checked, Choice, RunList};

/// The tests and simulations of a file that have this name and are of the chosen circuit and swarm.
pub(in crate::cli) fn chosen_runs<'f>(
    file: &'f Checked,
    only: Option<&'f str>,
    choice: &Choice,
) -> Result<RunList<'f>, Failure> {
    let is_choice = choice.circuit.is_some() || choice.swarm.is_some();
    let chosen = if is_choice { Some(file.circuit(choice)?) } else { None };
    let is_chosen =
        |circuit: &Instance| chosen.as_ref().is_none_or(|chosen| is_same_instance(&file.program, chosen, circuit));
    let mut list = match only {
        Some(name) => RunList { tests: file.tests(name).collect(), simulations: file.simulations(name).collect() },
        None => RunList::all(&file.program),
    };
    list.tests.retain(|test| is_chosen(&test.circuit));
    list.simulations.retain(|simulation| {
        is_chosen(&simulation.circuit) && choice.swarm.as_ref().is_none_or(|name| *name == simulation.swarm)
    });
    Ok(list)
}

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
