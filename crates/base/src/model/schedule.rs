//! Schedules: which stimuli are present and for how long.

use serde::{Deserialize, Serialize};

use super::Pattern;

/// One spell of a schedule: a pattern that stays for a number of env steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Spell {
    /// The stimuli that are present.
    pub pattern: Pattern,
    /// The duration in env steps.
    pub steps: u32,
}

/// Spells one after another, without a reset between them.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Schedule {
    /// The spells in order of time.
    pub spells: Vec<Spell>,
}

impl Schedule {
    /// A schedule of one spell: a pattern for that many env steps.
    pub fn constant(pattern: Pattern, steps: u32) -> Self {
        Self { spells: vec![Spell { pattern, steps }] }
    }

    /// The length of all spells together, in env steps.
    pub fn steps(&self) -> u32 {
        self.spells.iter().map(|spell| spell.steps).sum()
    }

    /// The pattern of each env step, first to last.
    pub fn patterns(&self) -> impl Iterator<Item = Pattern> + '_ {
        self.spells.iter().flat_map(|spell| std::iter::repeat_n(spell.pattern, spell.steps as usize))
    }
}
