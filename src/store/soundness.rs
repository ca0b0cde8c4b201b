//! Checks whether the values of a robot file are possible.

use crate::diag::{Code, Diagnostic};
use crate::model::{Behavior, Character, Robot};
use crate::source::SourceFile;
use crate::store::yaml;

/// The longest clock and settle time of a robot, in cycles; the longest that is measured is 13.
const MAX_CYCLES: u32 = 1000;
/// The longest name.
const MAX_NAME: usize = 100;

/// Refuses a robot that no measurement can have given.
///
/// # Errors
/// A diagnostic at the field that is wrong.
pub(super) fn check(file: &SourceFile, robot: &Robot) -> Result<(), Diagnostic> {
    let bad = |field: &str, message: String| {
        let message = format!("`{}` is not a sound robot file: {message}", file.name);
        Err(Diagnostic::new(Code::RobotFile, message, yaml::key_span(file, field), "here"))
    };
    if let Some((field, message)) = words(robot).or_else(|| motion(robot)).or_else(|| character(&robot.character)) {
        return bad(field, message);
    }
    let weights = robot.genotype.iter().flat_map(|genotype| &genotype.links).map(|link| link.weight);
    if weights.into_iter().any(|weight| !weight.is_finite()) {
        return bad("genotype", "a weight of the network is not a finite number".to_owned());
    }
    Ok(())
}

/// The error, with the name of the field.
type Flaw = (&'static str, String);

fn words(robot: &Robot) -> Option<Flaw> {
    let name = &robot.name;
    let is_name = !name.is_empty()
        && name.len() <= MAX_NAME
        && !name.starts_with('.')
        && name.chars().all(|c| c.is_ascii_alphanumeric() || "_-+.".contains(c));
    if !is_name {
        let text = format!(
            "a robot cannot be called `{name}`; expected up to {MAX_NAME} letters, digits, `_`, `-`, `+` and `.`"
        );
        return Some(("name", text));
    }
    let provenance = &robot.provenance;
    let words =
        [("program", &provenance.program), ("version", &provenance.version), ("evolution", &provenance.evolution)];
    let (field, _) = words.into_iter().find(|(_, word)| word.len() > MAX_NAME || word.chars().any(char::is_control))?;
    Some((field, format!("`{field}` is longer than {MAX_NAME} bytes or has control characters")))
}

fn motion(robot: &Robot) -> Option<Flaw> {
    let displacement = &robot.displacement;
    if displacement.iter().any(|voxels| !voxels.is_finite()) {
        return Some(("displacement", "a displacement is not a finite number".to_owned()));
    }
    let meant = Behavior::of(displacement);
    (meant != robot.behavior)
        .then(|| ("behavior", format!("behavior `{}`, but the displacements are those of `{meant}`", robot.behavior)))
}

fn character(character: &Character) -> Option<Flaw> {
    let Character { clock, error_rate, glitch_rate, margin, settle, .. } = character;
    if !(1..=MAX_CYCLES).contains(clock) {
        return Some(("clock", format!("a clock of {clock} cycles, expected 1 to {MAX_CYCLES}")));
    }
    for (field, rate) in [("error_rate", *error_rate), ("glitch_rate", *glitch_rate)] {
        if !(0.0..=1.0).contains(&rate) {
            return Some((field, format!("`{field}` of {rate}, expected a share from 0 to 1")));
        }
    }
    if !margin.is_finite() {
        return Some(("margin", "the margin is not a finite number".to_owned()));
    }
    let slow = settle.iter().find(|transition| !(1..=MAX_CYCLES).contains(&transition.cycles))?;
    Some(("settle", format!("a settle time of {} cycles, expected 1 to {MAX_CYCLES}", slow.cycles)))
}
