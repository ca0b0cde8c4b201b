//! Robots of a library as a table, as one page, and as data, and the result of `library add` for a behavior: a robot,
//! or the reason why there is none.

use std::fmt;
use std::sync::Arc;

use serde::Serialize;

use crate::looks::material_words;
use crate::{Align, TextTable};
use nbc_base::diag::counted;
use nbc_base::model::{Behavior, Displacements, Library, Palette, Pattern, Robot, SafeRadius, Transition};
use nbc_swarm::Selected;

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Listing {
    pub name: String,
    pub behavior: String,
    pub function: &'static str,
    /// Columns and rows, such as `5x5`.
    #[serde(rename = "box")]
    pub bounds: String,
    /// Cycles for which a pattern must be held.
    pub clock: u32,
    /// The longest settle time in cycles; none if it was not measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub settle: Option<u32>,
    /// The smallest displacement in voxels per cycle.
    pub margin: f64,
    /// How far worlds may differ before it makes errors, if that was measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius: Option<SafeRadius>,
    /// The share of random switches with a wrong output.
    pub error_rate: f64,
    pub switches: u32,
    /// The share of wrong cycles in which the output should not change.
    pub glitch_rate: f64,
    pub body: Vec<String>,
    /// The materials of the codes, if they are not the paper's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub materials: Option<Arc<Palette>>,
}

impl Listing {
    pub fn of(robot: &Robot) -> Self {
        let character = &robot.character;
        Self {
            name: robot.name.clone(),
            behavior: robot.behavior.to_string(),
            function: robot.function().name(),
            bounds: format!("{}x{}", robot.body.width(), robot.body.height()),
            clock: character.clock,
            settle: character.settle.iter().map(|transition| transition.cycles).max(),
            margin: character.margin,
            radius: character.radius.clone(),
            error_rate: character.error_rate,
            switches: character.switches,
            glitch_rate: character.glitch_rate,
            body: robot.body.rows(),
            materials: robot.body.own_materials(),
        }
    }

    pub fn all(library: &Library) -> Vec<Self> {
        library.robots.iter().map(Self::of).collect()
    }

    pub fn table(list: &[Self]) -> TextTable {
        use Align::{Left, Right};
        let mut table = TextTable::new(&[
            ("function", Left),
            ("robot", Left),
            ("behavior", Left),
            ("box", Left),
            ("clock", Right),
            ("settles", Right),
            ("margin", Right),
            ("radius", Right),
            ("errors", Right),
            ("glitches", Right),
        ]);
        for robot in list {
            table.push(vec![
                robot.function.to_owned(),
                robot.name.clone(),
                robot.behavior.clone(),
                robot.bounds.clone(),
                robot.clock.to_string(),
                robot.settle.map_or(String::new(), |cycles| cycles.to_string()),
                format!("{:.3}", robot.margin),
                robot.radius.as_ref().map_or(String::new(), |found| found.radius.to_string()),
                percent(robot.error_rate),
                percent(robot.glitch_rate),
            ]);
        }
        table
    }
}

fn percent(share: f64) -> String {
    if share == 0.0 { "0".to_owned() } else { format!("{:.2} %", share * 100.0) }
}

pub(super) fn walked(displacement: &Displacements) -> String {
    let behavior = displacement.behavior();
    let one = |(pattern, voxels): (Pattern, &f64)| format!("{} {voxels:+.2}", pattern.digits(behavior.stimuli()));
    behavior.patterns().zip(displacement.iter()).map(one).collect::<Vec<_>>().join(", ")
}

pub fn describe_robot(robot: &Robot) -> String {
    let (character, provenance) = (&robot.character, &robot.provenance);
    let drawing = robot.body.rows().join("\n    ").replace('0', ".");
    let clock =
        format!("{}, margin {:.3} voxels a cycle", counted(character.clock as usize, "cycle"), character.margin);
    let errors = format!(
        "{} of {} switches, glitches {}",
        percent(character.error_rate),
        character.switches,
        percent(character.glitch_rate)
    );
    format!(
        "{name}: {function}, {behavior}, {width}x{height}{topples}\n\n    {drawing}\n\n{legend}\n\n\
         displacement  {displacement} voxels in 10 cycles\n\
         clock         {clock}\n\
         errors        {errors}\n\
         settles       {settles}\n\
         worlds        {worlds}\n\
         made by       {program} {version}, evolution {evolution}, seed {seed}, generation {generation}, \
         {evaluations}\n",
        name = robot.name,
        function = robot.function(),
        behavior = robot.behavior,
        width = robot.body.width(),
        height = robot.body.height(),
        topples = if character.topples { ", topples" } else { "" },
        legend = material_words(&robot.body).join("  "),
        displacement = walked(&robot.displacement),
        settles = settles(robot),
        worlds = worlds(robot),
        program = provenance.program,
        version = provenance.version,
        evolution = provenance.evolution,
        seed = provenance.seed,
        generation = provenance.generation,
        evaluations = counted(provenance.evaluations as usize, "evaluation"),
    )
}

fn worlds(robot: &Robot) -> String {
    let Some(SafeRadius { vary, worlds, radius, error_rate, .. }) = &robot.character.radius else {
        return "not measured".to_owned();
    };
    let errors = error_rate.map_or(String::new(), |rate| format!(", {} of switches wrong at radius 1", percent(rate)));
    let worlds = counted(*worlds as usize, "world");
    format!("radius {radius} in {worlds}, radius 1 is {vary}{errors}")
}

/// The settle times, grouped: `1: 00>01 01>11, 2: 11>10`.
fn settles(robot: &Robot) -> String {
    let mut times: Vec<u32> = robot.character.settle.iter().map(|transition| transition.cycles).collect();
    times.sort_unstable();
    times.dedup();
    let of_time = |&cycles: &u32| {
        let same = robot.character.settle.iter().filter(|transition| transition.cycles == cycles);
        let word = |one: &Transition| format!("{}>{}", one.from.digits(one.stimuli), one.to.digits(one.stimuli));
        let words: Vec<String> = same.map(word).collect();
        format!("in {cycles}: {}", words.join(" "))
    };
    if times.is_empty() { "not measured".to_owned() } else { times.iter().map(of_time).collect::<Vec<_>>().join("; ") }
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Answer {
    /// Its four letters.
    pub behavior: String,
    pub function: &'static str,
    pub outcome: Outcome,
    /// Why no robot was added.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub robot: Option<Listing>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    Added,
    LeftOut,
    Missing,
}

impl Answer {
    pub fn of(behavior: Behavior, selected: &Selected, max_error: f64) -> Self {
        let listing = |robot: &Robot| Some(Listing::of(robot));
        let (outcome, reason, robot) = match selected {
            Selected::Robot(robot) => (Outcome::Added, None, listing(robot)),
            Selected::Erring(robot) => (Outcome::LeftOut, Some(errors(robot, max_error)), listing(robot)),
            Selected::Other(other) => {
                let reason = format!("its best elite walks {other} when it is measured");
                (Outcome::LeftOut, Some(reason), None)
            }
            Selected::Faulty(fault) => {
                let reason = format!("its best elite {} in env step {}", fault.kind, fault.env_step);
                (Outcome::LeftOut, Some(reason), None)
            }
            Selected::Missing => (Outcome::Missing, Some("no elite of this behavior".to_owned()), None),
        };
        Self { behavior: behavior.to_string(), function: behavior.function().name(), outcome, reason, robot }
    }

    pub fn is_added(&self) -> bool {
        self.outcome == Outcome::Added
    }
}

fn errors(robot: &Robot, max_error: f64) -> String {
    let character = &robot.character;
    let wrong = (character.error_rate * f64::from(character.switches)).round();
    let (rate, most) = (100.0 * character.error_rate, 100.0 * max_error);
    format!("{wrong} of {} switches wrong ({rate:.2} %), at most {most} % accepted", character.switches)
}

impl fmt::Display for Answer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}  {:<10}  ", self.behavior, self.function)?;
        match (self.outcome, &self.robot) {
            (Outcome::Added, Some(Listing { name, clock, margin, error_rate, .. })) => {
                write!(f, "added     {name}, clock {clock}, margin {margin:.3}")?;
                if *error_rate > 0.0 {
                    write!(f, ", {:.2} % of the switches wrong", 100.0 * error_rate)?;
                }
            }
            (Outcome::Missing, _) => f.write_str("none")?,
            _ => f.write_str("left out")?,
        }
        match &self.reason {
            Some(reason) => writeln!(f, ": {reason}"),
            None => writeln!(f),
        }
    }
}
