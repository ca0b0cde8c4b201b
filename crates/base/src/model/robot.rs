//! Robots: bodies whose behavior is known, and libraries of them.

use std::cmp::Ordering;

use serde::{Deserialize, Serialize};

use super::{Behavior, Body, Function, Genotype, Pattern};

/// A body with a known behavior and its provenance.
#[derive(Clone, Debug, PartialEq)]
pub struct Robot {
    /// The robot's name, unique in its library.
    pub name: String,
    /// The directions in which it walks, one for each pattern of two stimuli.
    pub behavior: Behavior,
    /// The voxels, with the palette that says what they are made of.
    pub body: Body,
    /// Displacement in voxels over the paper's fixed simulations, patterns 00, 01, 10, 11 (docs/physics.md 10).
    pub displacement: [f64; 4],
    /// How reliable and how quick it is as a gate.
    pub character: Character,
    /// The run of evolution that made it.
    pub provenance: Provenance,
    /// The network it was developed from.
    pub genotype: Option<Genotype>,
}

impl Robot {
    /// The gate that it is: its behavior with right as 1 and left as 0.
    pub fn function(&self) -> Function {
        self.behavior.function()
    }
}

/// The character of a robot as a gate, measured over switches of its inputs (docs/physics.md 14).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Character {
    /// Cycles for which an input pattern must be held so that the output is correct at the end of every hold.
    pub clock: u32,
    /// The number of random switches in which wrong outputs were counted.
    pub switches: u32,
    /// The share of `switches` with a wrong output at the end of a hold of `clock` cycles.
    pub error_rate: f64,
    /// The share of wrong cycles in holds whose output should not change.
    pub glitch_rate: f64,
    /// The smallest displacement in the correct direction at the end of a hold, in voxels per cycle; negative if an
    /// output was wrong.
    pub margin: f64,
    /// Whether the body ever fell over.
    pub topples: bool,
    /// Settle times, one entry for each of the twelve transitions between different patterns.
    pub settle: Vec<Transition>,
    /// How far a world may differ before the robot makes errors, if that was measured.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius: Option<SafeRadius>,
}

/// How far a world may differ before a robot makes errors.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SafeRadius {
    /// The largest changes of the worlds at radius 1, such as `friction=10%,gravity=5%`.
    pub vary: String,
    /// The number of worlds that were tried at each radius.
    pub worlds: u32,
    /// The seed from which the worlds were drawn.
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
#[serde(deny_unknown_fields)]
pub struct Transition {
    /// The pattern of two stimuli before the switch.
    #[serde(with = "pair")]
    pub from: Pattern,
    /// The pattern of two stimuli after the switch.
    #[serde(with = "pair")]
    pub to: Pattern,
    /// Cycles after the switch until the output is correct and stays correct.
    pub cycles: u32,
}

/// The provenance of a robot: enough to make it again.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Provenance {
    /// The program that made it.
    pub program: String,
    /// The version of that program.
    pub version: String,
    /// The name of the declaration of the run.
    pub evolution: String,
    /// The seed of the run.
    pub seed: u64,
    /// The generation in which the robot was born.
    pub generation: u32,
    /// Evaluations made in the run up to then.
    pub evaluations: u64,
}

/// Robots to build circuits from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Library {
    /// The robots, best first within each function.
    pub robots: Vec<Robot>,
}

impl Library {
    /// The robots that compute a function, best first.
    pub fn robots_for(&self, function: Function) -> impl Iterator<Item = &Robot> {
        self.robots.iter().filter(move |robot| robot.function() == function)
    }
}

/// Patterns of two stimuli written as two digits.
mod pair {
    use serde::{Deserialize, Deserializer, Serializer, de::Error};

    use crate::model::{Pattern, PatternError};

    pub fn serialize<S: Serializer>(pattern: &Pattern, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&pattern.to_string())
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Pattern, D::Error> {
        let word = String::deserialize(deserializer)?;
        Pattern::PAIRS
            .into_iter()
            .find(|pattern| pattern.to_string() == word)
            .ok_or_else(|| D::Error::custom(PatternError::Pair { found: word }))
    }
}
