//! Behaviors: the direction in which a robot walks under each pattern of its stimuli.

use std::fmt;
use std::ops::Deref;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use super::wording::{displacement_count, not_behavior};
use super::{Function, Pattern};

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Direction {
    /// Towards negative x: output 0. Standing still counts as left (docs/physics.md 10).
    Left,
    Right,
}

impl Direction {
    pub fn of(displacement: f64) -> Self {
        if displacement > 0.0 { Self::Right } else { Self::Left }
    }

    /// 1 to the right, -1 to the left: a displacement times it is a distance in this direction.
    pub fn sign(self) -> f64 {
        if self == Self::Right { 1.0 } else { -1.0 }
    }
}

/// The directions under each pattern of two or three stimuli, counted as binary numbers with stimulus 1 first, written
/// as letters: `RRRL` for the patterns 00, 01, 10, 11 (paper, section 3), eight for three stimuli.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(extend("pattern" = "^([LR]{4}){1,2}$")))]
#[serde(try_from = "String", into = "String")]
pub struct Behavior(Function);

impl Behavior {
    pub fn of(displacements: &[f64]) -> Self {
        let right = |(i, &voxels): (usize, &f64)| u8::from(Direction::of(voxels) == Direction::Right) << i;
        let bits = displacements.iter().enumerate().map(right).sum();
        Self(Function::of(displacements.len().ilog2() as usize, bits))
    }

    /// The function of this behavior, reading right as 1.
    pub fn function(self) -> Function {
        self.0
    }

    pub fn stimuli(self) -> usize {
        self.0.inputs()
    }

    /// The patterns of its stimuli, in the order of its letters.
    pub fn patterns(self) -> impl Iterator<Item = Pattern> {
        Pattern::all(self.stimuli())
    }

    pub fn direction(self, pattern: Pattern) -> Direction {
        if self.0.under(pattern) { Direction::Right } else { Direction::Left }
    }

    /// All of two or three stimuli, in order of their functions' bits: 16 or 256.
    pub fn all(stimuli: usize) -> impl Iterator<Item = Self> {
        Function::all_of(stimuli).map(Self)
    }
}

impl From<Function> for Behavior {
    fn from(function: Function) -> Self {
        Self(function)
    }
}

impl fmt::Display for Behavior {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let letter = |pattern| if self.direction(pattern) == Direction::Right { 'R' } else { 'L' };
        f.pad(&self.patterns().map(letter).collect::<String>())
    }
}

impl FromStr for Behavior {
    type Err = String;

    fn from_str(word: &str) -> Result<Self, String> {
        let stimuli = match word.len() {
            4 => 2,
            8 => 3,
            _ => return Err(not_behavior(word)),
        };
        let bit = |(i, letter): (usize, char)| match letter {
            'L' => Some(0),
            'R' => Some(1 << i),
            _ => None,
        };
        let bits = word.chars().enumerate().map(bit).sum::<Option<u8>>().ok_or_else(|| not_behavior(word))?;
        Ok(Self(Function::of(stimuli, bits)))
    }
}

impl TryFrom<String> for Behavior {
    type Error = String;

    fn try_from(word: String) -> Result<Self, String> {
        word.parse()
    }
}

impl From<Behavior> for String {
    fn from(behavior: Behavior) -> Self {
        behavior.to_string()
    }
}

/// Displacements in voxels, one for each pattern of two or three stimuli, counted as binary numbers with stimulus 1
/// first.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(try_from = "Vec<f64>", into = "Vec<f64>")]
pub struct Displacements {
    stimuli: u8,
    // Those of two stimuli fill the first four.
    voxels: [f64; 8],
}

impl Displacements {
    pub fn under(stimuli: usize, displacement: impl FnMut(Pattern) -> f64) -> Self {
        let voxels: Vec<f64> = Pattern::all(stimuli).map(displacement).collect();
        Self::try_from(voxels).expect("bodies sense two or three stimuli")
    }

    pub fn zero(stimuli: usize) -> Self {
        Self::under(stimuli, |_| 0.0)
    }

    pub fn at(&self, pattern: Pattern) -> f64 {
        self[pattern.number(self.stimuli.into())]
    }

    pub fn behavior(&self) -> Behavior {
        Behavior::of(self)
    }
}

impl Deref for Displacements {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        &self.voxels[..1 << self.stimuli]
    }
}

impl TryFrom<Vec<f64>> for Displacements {
    type Error = String;

    fn try_from(found: Vec<f64>) -> Result<Self, String> {
        let stimuli = match found.len() {
            4 => 2,
            8 => 3,
            found => return Err(displacement_count(found)),
        };
        let mut voxels = [0.0; 8];
        voxels[..found.len()].copy_from_slice(&found);
        Ok(Self { stimuli, voxels })
    }
}

impl From<Displacements> for Vec<f64> {
    fn from(displacements: Displacements) -> Self {
        displacements.to_vec()
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

    #[test]
    fn behaviors_of_three_stimuli_have_eight_letters() {
        let maj: Behavior = "LLLRLRRR".parse().unwrap();
        assert_eq!((maj.function(), maj.to_string().as_str(), maj.stimuli()), (Function::MAJ, "LLLRLRRR", 3));
        assert_eq!(maj.direction(Pattern::new(&[true, false, true])), Direction::Right);
        assert_eq!(maj.direction(Pattern::new(&[false, false, true])), Direction::Left);
        for word in ["LLLRLRR", "LLLRLRRX", "", "lllr"] {
            assert!(word.parse::<Behavior>().is_err(), "{word:?}");
        }
        assert!(Behavior::all(3).all(|behavior| behavior.to_string().parse() == Ok(behavior)));
    }

    #[test]
    fn displacements_are_as_many_as_patterns() {
        let read = |text: &str| serde_json::from_str::<Displacements>(text);
        let found = read("[0.0, 0.5, -1.0, 0.0, 0.0, 0.0, 0.0, 2.0]").unwrap();
        assert_eq!(found.behavior().to_string(), "LRLLLLLR");
        assert_eq!(found.at(Pattern::new(&[false, true, false])), -1.0);
        assert_eq!(serde_json::to_string(&Displacements::zero(2)).unwrap(), "[0.0,0.0,0.0,0.0]");
        assert!(read("[1.0, 2.0, 3.0]").is_err());
    }
}
