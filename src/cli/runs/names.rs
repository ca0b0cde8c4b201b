//! The names by which users choose tests and simulations.

use std::collections::BTreeSet;

use crate::cli::Failure;
use crate::cli::runs::wording;
use nbc_base::diag::Diagnostic;
use nbc_base::model::Instance;
use nbc_circuit::is_same_instance;
use nbc_session::{Checked, Choice, RunList};

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
