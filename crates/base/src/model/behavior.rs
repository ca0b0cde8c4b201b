//! Behaviors: the direction in which a robot walks under each pattern of two stimuli.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use super::{BehaviorError, Function, Pattern};

/// The direction in which a robot walks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Direction {
    /// Towards negative x: output 0. Standing still counts as left (docs/physics.md 10).
    Left,
    /// Towards positive x: output 1.
    Right,
}

impl Direction {
    /// The direction of a displacement along x.
    pub fn of(displacement: f64) -> Self {
        if displacement > 0.0 { Self::Right } else { Self::Left }
    }
}

/// The directions under the patterns 00, 01, 10, 11, written as four letters such as `RRRL` (paper, section 3).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Behavior(Function);

impl Behavior {
    /// The behavior with these displacements under the patterns 00, 01, 10, 11.
    pub fn of(displacements: &[f64; 4]) -> Self {
        let right = |i: usize| u8::from(Direction::of(displacements[i]) == Direction::Right) << i;
        Self(Function::new((0..4).map(right).sum()))
    }

    /// The function of this behavior, reading right as 1.
    pub fn function(self) -> Function {
        self.0
    }

    /// The direction under a pattern of two stimuli.
    pub fn direction(self, pattern: Pattern) -> Direction {
        if self.0.output(pattern.has(0), pattern.has(1)) { Direction::Right } else { Direction::Left }
    }

    /// All sixteen, in order of their functions' bits.
    pub fn all() -> impl Iterator<Item = Self> {
        Function::all().map(Self)
    }
}

impl From<Function> for Behavior {
    fn from(function: Function) -> Self {
        Self(function)
    }
}

impl fmt::Display for Behavior {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let letters: String = Pattern::PAIRS
            .iter()
            .map(|&pattern| if self.direction(pattern) == Direction::Right { 'R' } else { 'L' })
            .collect();
        f.pad(&letters)
    }
}

impl FromStr for Behavior {
    type Err = BehaviorError;

    fn from_str(word: &str) -> Result<Self, BehaviorError> {
        Self::all().find(|behavior| behavior.to_string() == word).ok_or_else(|| BehaviorError(word.to_owned()))
    }
}

impl TryFrom<String> for Behavior {
    type Error = BehaviorError;

    fn try_from(word: String) -> Result<Self, BehaviorError> {
        word.parse()
    }
}

impl From<Behavior> for String {
    fn from(behavior: Behavior) -> Self {
        behavior.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_papers_behaviors_are_the_papers_gates() {
        assert_eq!("RRRL".parse::<Behavior>().unwrap().function(), Function::NAND);
        assert_eq!("LRRL".parse::<Behavior>().unwrap().function(), Function::XOR);
        assert_eq!("RRLL".parse::<Behavior>().unwrap().function(), Function::NOT);
        assert_eq!(Behavior::of(&[1.0, 0.5, 0.1, -0.1]).to_string(), "RRRL");
        assert_eq!(Behavior::of(&[0.0; 4]).to_string(), "LLLL");
    }
}
