//! Hovers of functions and libraries: their robots.

use std::collections::BTreeSet;

use crate::files::Files;
use crate::hover::picture::image;
use crate::spot::Spot;
use nbc_base::diag::counted;
use nbc_base::model::{Behavior, Function, Library, Robot};
use nbc_lang::syntax::tree::{Declaration, DeclarationKind};
use nbc_session::CompileOptions;
use nbc_session::report::{self, Listing, Portrait, Scheme};

pub(super) fn of_library(files: &Files<'_>, name: &str, pictures: bool) -> Option<String> {
    let library = files.checked.robots(Some(name), &CompileOptions::default()).ok()?;
    let mut seen = BTreeSet::new();
    let best: Vec<&Robot> = library.robots.iter().filter(|robot| seen.insert(robot.function())).collect();
    let (robots, functions) = (counted(library.robots.len(), "robot"), counted(best.len(), "function"));
    let mut text = format!("{robots} for {functions}; the best for each:\n\n{}", table(&best));
    if pictures && !best.is_empty() {
        let portrait = |robot: &&Robot| Portrait {
            title: robot.function().name().to_owned(),
            subtitle: robot.name.clone(),
            body: robot.body.clone(),
        };
        let portraits: Vec<Portrait> = best.iter().map(portrait).collect();
        text.push_str(&format!("\n{}", image(name, &report::draw_portraits(name, &portraits, Scheme::default()))));
    }
    Some(text)
}

/// The robot of the circuit's swarm, or of the default library.
pub(super) fn of_operator(spot: &Spot<'_>, around: Option<&Declaration>, word: &str, pictures: bool) -> Option<String> {
    let checked = spot.files.checked;
    let circuit = around.and_then(|around| match &around.kind {
        DeclarationKind::Circuit(circuit) => Some(circuit.name.text.as_str()),
        DeclarationKind::Prove(claim) => Some(claim.circuit.name.text.as_str()),
        DeclarationKind::Test(test) => Some(test.circuit.name.text.as_str()),
        _ => None,
    });
    let swarm = checked.program.swarms.iter().find(|swarm| Some(swarm.circuit.circuit.as_str()) == circuit);
    let library = swarm.map(|swarm| swarm.library.as_str());
    let library = checked.robots(library, &CompileOptions::default()).ok()?;
    best(&library, Function::parse(word)?, pictures)
}

pub(super) fn of_behavior(files: &Files<'_>, library: &str, word: &str, pictures: bool) -> Option<String> {
    let function = Function::parse(word).or_else(|| word.parse().ok().map(Behavior::function))?;
    files.checked.program.library(library)?;
    let library = files.checked.robots(Some(library), &CompileOptions::default()).ok()?;
    best(&library, function, pictures)
}

fn best(library: &Library, function: Function, pictures: bool) -> Option<String> {
    let robot = library.robots_for(function).next()?;
    let mut text = format!("The best robot for `{function}`:\n\n{}", table(&[robot]));
    if pictures {
        text.push_str(&format!("\n{}", image(&robot.name, &report::draw_sprite(robot, Scheme::default()))));
    }
    Some(text)
}

fn table(robots: &[&Robot]) -> String {
    let row = |robot: &&Robot| {
        let Listing { name, function, bounds, clock, margin, error_rate, switches, .. } = Listing::of(robot);
        let errors = error_rate * 100.0;
        format!("| {function} | `{name}` | {bounds} | {clock} | {margin:.3} | {errors:.2} % of {switches} |\n")
    };
    let rows: String = robots.iter().map(row).collect();
    format!("| function | robot | box | clock | margin | errors |\n|---|---|---|---|---|---|\n{rows}")
}
