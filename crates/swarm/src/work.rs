//! The amount of simulation in an evaluation.

use serde::{Deserialize, Serialize};

/// The env steps of an evaluation, and those saved compared with a full evaluation of everything.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Work {
    pub env_steps: u64,
    /// Env steps left out because their result could not have mattered.
    pub left_out: u64,
}

impl Work {
    pub fn plus(self, other: Self) -> Self {
        Self { env_steps: self.env_steps + other.env_steps, left_out: self.left_out + other.left_out }
    }
}
