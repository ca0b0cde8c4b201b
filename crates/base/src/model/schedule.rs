//! Schedules: which stimuli are present and for how long.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::{Image, Pattern};

/// One spell of a schedule: stimuli that stay for a number of env steps.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Spell {
    pub pattern: Pattern,
    /// The image that is shown. Its pattern then says what it stands for: bodies that sense images sense no pattern.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub image: Option<Arc<Image>>,
    /// The duration in env steps.
    pub steps: u32,
}

impl Spell {
    pub fn of(pattern: Pattern, steps: u32) -> Self {
        Self { pattern, image: None, steps }
    }

    pub fn value(&self, stimulus: usize) -> f64 {
        if self.pattern.has(stimulus) { 1.0 } else { 0.0 }
    }

    /// The value of the image over a place of a body's box: row and column, height and width. Without an image it is 0.
    pub fn value_over(&self, place: [usize; 2], size: [usize; 2]) -> f64 {
        self.image.as_ref().map_or(0.0, |image| image.over(place, size))
    }
}

/// Spells one after another, without a reset between them.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Schedule {
    pub spells: Vec<Spell>,
}

impl Schedule {
    /// The pattern that numbers a set of images, of which there are at most four.
    pub fn of_set(number: usize) -> Pattern {
        Pattern::new(&[number & 1 == 1, number >> 1 & 1 == 1])
    }

    pub fn constant(pattern: Pattern, steps: u32) -> Self {
        Self { spells: vec![Spell::of(pattern, steps)] }
    }

    pub fn steps(&self) -> u32 {
        self.spells.iter().map(|spell| spell.steps).sum()
    }

    pub fn patterns(&self) -> impl Iterator<Item = Pattern> + '_ {
        self.spells.iter().flat_map(|spell| std::iter::repeat_n(spell.pattern, spell.steps as usize))
    }
}
