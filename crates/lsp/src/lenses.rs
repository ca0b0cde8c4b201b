//! Code lenses: commands above declarations.

use gen_lsp_types::{CodeLens, Command};
use serde_json::{Value, json};

use crate::figures::Subject;
use crate::files::Files;
use crate::runs;
use nbc_base::model::Instance;
use nbc_base::source::{FileId, Span};

pub(super) fn of_runs(files: &Files<'_>, file: FileId) -> Vec<CodeLens> {
    let program = &files.checked.program;
    let mut lenses = Vec::new();
    for (at, test) in program.tests.iter().enumerate().filter(|(_, test)| test.span.file == file) {
        let order = json!({ "uri": files.own(), "test": at });
        lenses.push(lens(files, test.span, "run in physics", runs::RUN, order.clone()));
        lenses.push(lens(files, test.span, "run as logic", runs::TEST, order));
    }
    for (at, simulation) in program.simulations.iter().enumerate().filter(|(_, run)| run.span.file == file) {
        let order = json!({ "uri": files.own(), "simulation": at });
        lenses.push(lens(files, simulation.span, "run in physics", runs::RUN, order));
    }
    for (at, claim) in program.claims.iter().enumerate().filter(|(_, claim)| claim.span.file == file) {
        lenses.push(lens(files, claim.span, "prove", runs::PROVE, json!({ "uri": files.own(), "claim": at })));
    }
    lenses
}

pub(super) fn subjects(files: &Files<'_>, file: FileId) -> Vec<(Span, Instance, Option<String>)> {
    let checked = files.checked;
    let circuits = checked.program.circuits.iter().filter(|circuit| circuit.span.file == file);
    let circuits = circuits.filter_map(|circuit| Some((circuit.span, checked.in_use(circuit)?, None)));
    let swarms = checked.program.swarms.iter().filter(|swarm| swarm.span.file == file);
    let swarms = swarms.map(|swarm| (swarm.span, swarm.circuit.clone(), Some(swarm.name.clone())));
    circuits.chain(swarms).collect()
}

pub(super) fn of_subject(files: &Files<'_>, place: Span, subject: &Subject, summary: Option<String>) -> Vec<CodeLens> {
    let Subject::Circuit(circuit, swarm) = subject else { return Vec::new() };
    let order = json!({ "uri": files.own(), "circuit": circuit.to_string(), "swarm": swarm });
    let schematic = lens(files, place, "schematic", runs::SCHEMATIC, order.clone());
    let figures = summary.map(|summary| lens(files, place, &summary, runs::TIMING, order));
    [schematic].into_iter().chain(figures).collect()
}

fn lens(files: &Files<'_>, place: Span, title: &str, command: &str, order: Value) -> CodeLens {
    CodeLens {
        range: files.range(place),
        command: Some(Command {
            title: title.to_owned(),
            tooltip: None,
            command: command.to_owned(),
            arguments: Some(vec![order]),
        }),
        data: None,
    }
}
