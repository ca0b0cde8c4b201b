//! Robots: bodies whose behavior is known, and libraries of them.

use std::cmp::Ordering;

use serde::{Deserialize, Serialize};

use super::{Behavior, Body, Displacements, Function, Genotype, Pattern, wording};

/// A body with a known behavior and its provenance.
#[derive(Clone, Debug, PartialEq)]
pub struct Robot {
    /// The robot's name, unique in its library.
    pub name: String,
    pub behavior: Behavior,
    pub body: Body,
    /// Displacement in voxels over the paper's fixed simulations, one for each pattern (docs/physics.md 10).
    pub displacement: Displacements,
    pub character: Character,
    pub provenance: Provenance,
    pub genotype: Option<Genotype>,
}

impl Robot {
    /// The gate that it is: its behavior with right as 1 and left as 0.
    pub fn function(&self) -> Function {
        self.behavior.function()
    }
}

/// The character of a robot as a gate, measured over switches of its inputs (docs/physics.md 14).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Character {
    /// Cycles for which an input pattern must be held so that the output is correct at the end of every hold.
    pub clock: u32,
    /// The number of random switches in which wrong outputs were counted.
    pub switches: u32,
    /// The share of `switches` with a wrong output at the end of a hold of `clock` cycles.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub error_rate: f64,
    /// The share of wrong cycles in holds whose output should not change.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub glitch_rate: f64,
    /// The smallest displacement in the correct direction at the end of a hold, in voxels per cycle; negative if an
    /// output was wrong.
    pub margin: f64,
    /// Whether the body ever fell over.
    pub topples: bool,
    /// Settle times, one entry for each of the transitions between different patterns: 12 of two stimuli, 56 of
    /// three.
    pub settle: Vec<Transition>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius: Option<SafeRadius>,
}

/// How far a world may differ before a robot makes errors.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SafeRadius {
    /// The largest changes of the worlds at radius 1, such as `friction=10%,gravity=5%`.
    pub vary: String,
    /// The number of worlds that were tried at each radius.
    pub worlds: u32,
    pub seed: u64,
    /// The largest factor of the changes up to which no output was wrong.
    pub radius: f64,
    /// The share of switches with a wrong output in the worlds of radius 1, if it was counted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error_rate: Option<f64>,
}

impl Character {
    /// The more reliable first, then the shorter clock, then the greater margin.
    pub fn compare(&self, other: &Self) -> Ordering {
        (self.error_rate.total_cmp(&other.error_rate))
            .then(self.clock.cmp(&other.clock))
            .then(other.margin.total_cmp(&self.margin))
    }
}

/// The settle time of one input transition.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(try_from = "TransitionRecord", into = "TransitionRecord")]
pub struct Transition {
    pub stimuli: usize,
    pub from: Pattern,
    pub to: Pattern,
    /// Cycles after the switch until the output is correct and stays correct.
    pub cycles: u32,
}

/// A [`Transition`] as it is written: the patterns are digits.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
struct TransitionRecord {
    from: String,
    to: String,
    cycles: u32,
}

impl From<Transition> for TransitionRecord {
    fn from(Transition { stimuli, from, to, cycles }: Transition) -> Self {
        Self { from: from.digits(stimuli), to: to.digits(stimuli), cycles }
    }
}

impl TryFrom<TransitionRecord> for Transition {
    type Error = String;

    fn try_from(TransitionRecord { from, to, cycles }: TransitionRecord) -> Result<Self, String> {
        let stimuli = from.len();
        let read = |digits: String| match Pattern::try_from(digits.clone()) {
            Ok(pattern) if digits.len() == stimuli && (2..=Function::MOST_INPUTS).contains(&stimuli) => Ok(pattern),
            _ => Err(wording::not_gate_pattern(&digits)),
        };
        Ok(Self { stimuli, from: read(from)?, to: read(to)?, cycles })
    }
}

/// The provenance of a robot: enough to make it again.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Provenance {
    pub program: String,
    pub version: String,
    /// The name of the declaration of the run.
    pub evolution: String,
    pub seed: u64,
    pub generation: u32,
    /// Evaluations made in the run up to then.
    pub evaluations: u64,
}

impl Provenance {
    /// Of a body that no evolution made.
    pub fn unevolved(maker: &str) -> Self {
        let (program, version) = (crate::PROGRAM.to_owned(), crate::VERSION.to_owned());
        Self { program, version, evolution: maker.to_owned(), ..Self::default() }
    }
}

/// Robots to build circuits from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Library {
    /// The robots, best first within each function.
    pub robots: Vec<Robot>,
}

impl Library {
    pub fn robots_for(&self, function: Function) -> impl Iterator<Item = &Robot> {
        self.robots.iter().filter(move |robot| robot.function() == function)
    }
}
