//! Checks that the values of a robot file are possible.

use crate::{wording, yaml};
use nbc_base::diag::Diagnostic;
use nbc_base::model::{Character, Robot, SafeRadius, Variation};
use nbc_base::source::SourceFile;

/// The longest clock and settle time of a robot, in cycles; the longest that is measured is 13.
const MAX_CYCLES: u32 = 1000;
const MAX_NAME: usize = 100;

pub(super) fn check(file: &SourceFile, robot: &Robot) -> Result<(), Diagnostic> {
    let flaw =
        words(robot).or_else(|| motion(robot)).or_else(|| character(&robot.character)).or_else(|| weights(robot));
    match flaw {
        Some((field, flaw)) => Err(wording::unsound(file, &flaw, yaml::key_span(file, field))),
        None => Ok(()),
    }
}

type Flaw = (&'static str, String);

fn weights(robot: &Robot) -> Option<Flaw> {
    let mut links = robot.genotype.iter().flat_map(|genotype| &genotype.links);
    let is_bad = links.any(|link| !link.weight.is_finite());
    is_bad.then(|| ("genotype", wording::not_finite("a weight of the network")))
}

/// Whether a robot can have the name, which is also that of its file.
pub fn is_robot_name(name: &str) -> bool {
    !name.is_empty()
        && name.len() <= MAX_NAME
        && !name.starts_with('.')
        && name.chars().all(|c| c.is_ascii_alphanumeric() || "_-+.".contains(c))
}

fn words(robot: &Robot) -> Option<Flaw> {
    if !is_robot_name(&robot.name) {
        return Some(("name", wording::bad_name(&robot.name, MAX_NAME)));
    }
    let provenance = &robot.provenance;
    let words =
        [("program", &provenance.program), ("version", &provenance.version), ("evolution", &provenance.evolution)];
    let (field, _) = words.into_iter().find(|(_, word)| word.len() > MAX_NAME || word.chars().any(char::is_control))?;
    Some((field, wording::bad_provenance(field, MAX_NAME)))
}

fn motion(robot: &Robot) -> Option<Flaw> {
    let displacement = &robot.displacement;
    if displacement.iter().any(|voxels| !voxels.is_finite()) {
        return Some(("displacement", wording::not_finite("a displacement")));
    }
    let expected = displacement.behavior();
    (expected != robot.behavior).then(|| ("behavior", wording::other_behavior(robot.behavior, expected)))
}

fn character(character: &Character) -> Option<Flaw> {
    let Character { clock, error_rate, glitch_rate, margin, settle, radius, .. } = character;
    if !(1..=MAX_CYCLES).contains(clock) {
        return Some(("clock", wording::bad_cycles("a clock", *clock, MAX_CYCLES)));
    }
    for (field, rate) in [("error_rate", *error_rate), ("glitch_rate", *glitch_rate)] {
        if !(0.0..=1.0).contains(&rate) {
            return Some((field, wording::bad_share(field, rate)));
        }
    }
    if !margin.is_finite() {
        return Some(("margin", wording::not_finite("the margin")));
    }
    let is_radius = |found: &SafeRadius| {
        found.radius.is_finite()
            && found.error_rate.is_none_or(|rate| (0.0..=1.0).contains(&rate))
            && found.vary.parse::<Variation>().is_ok()
    };
    if !radius.as_ref().is_none_or(is_radius) {
        return Some(("radius", wording::bad_radius()));
    }
    let slow = settle.iter().find(|transition| !(1..=MAX_CYCLES).contains(&transition.cycles))?;
    Some(("settle", wording::bad_cycles("a settle time", slow.cycles, MAX_CYCLES)))
}
