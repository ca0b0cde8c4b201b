//! The results of a program's tests and simulations as one HTML file, with the cycles of their swarms.

use crate::wording;
use nbc_base::diag::Diagnostics;
use nbc_session::report::Scheme;
use nbc_session::{Checked, Choice, RunList, RunReport};

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExportedPage {
    pub html: String,
    pub circuit: String,
    pub robots: usize,
}

pub fn recorded_runs<'a>(checked: &'a Checked, choice: &Choice) -> Result<RunList<'a>, Diagnostics> {
    let list = RunList::chosen(checked, None, choice)?.in_physics();
    if list.is_empty() {
        let name = choice.circuit.as_ref().or(choice.swarm.as_ref()).unwrap_or(&checked.path);
        return Err(checked.fail(vec![wording::nothing_to_record(name)]));
    }
    Ok(list)
}

/// The page of a report in which nothing was cancelled.
pub fn recorded_page(source: &str, report: &RunReport) -> ExportedPage {
    let tests = report.tests.iter().filter_map(|run| run.swarm.as_ref());
    let swarms = tests.chain(report.simulations.iter().map(|run| &run.swarm));
    let compiled = &swarms.last().expect("there is something to record").compiled;
    ExportedPage {
        html: report.page(source, Scheme::default()),
        circuit: compiled.plan.circuit.to_string(),
        robots: compiled.assembly.members.len(),
    }
}
