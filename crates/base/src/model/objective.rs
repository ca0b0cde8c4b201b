//! What a search looks for.

use serde::{Deserialize, Serialize};

/// What makes a body better than another in its niche.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum SearchObjective {
    /// The paper's two fitnesses: the distance in the variable simulation, and the smallest distance in the fixed ones.
    #[default]
    Distance,
    /// Correct output in every cycle of random sequences, with the shortest clock.
    Gate,
    /// Correct output in the cycle of the stimuli themselves, while they may change in every cycle.
    Wave,
    /// The least distance over images, walked one way before those of some sets and the other way before the others.
    Images,
}

impl SearchObjective {
    pub const ALL: [(&str, Self); 4] =
        [("distance", Self::Distance), ("gate", Self::Gate), ("wave", Self::Wave), ("images", Self::Images)];

    /// Short words for the two fitnesses.
    pub fn columns(self) -> [&'static str; 2] {
        match self {
            Self::Distance => ["variable", "fixed"],
            Self::Gate => ["settled", "unchanged"],
            Self::Wave => ["steps", "worst"],
            // One number counts, which is both.
            Self::Images => ["least", "least"],
        }
    }

    /// The meaning of the first fitness, with its unit.
    pub fn meaning(self) -> &'static str {
        match self {
            Self::Distance | Self::Images => "distance (voxels)",
            Self::Gate | Self::Wave => "correct output (share)",
        }
    }
}
