//! Evolution runs as declared data: everything the paper fixes in code.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::{Palette, Schedule};

/// A declared evolution run (paper, Methods).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Evolution {
    /// The declaration's name.
    pub name: String,
    /// Columns of the bounding box.
    pub width: usize,
    /// Rows of the bounding box.
    pub height: usize,
    /// The materials a body may use.
    pub palette: Arc<Palette>,
    /// How often each kind of mutation is drawn.
    pub mutation: MutationWeights,
    /// The stimuli of the long simulation.
    pub variable: Schedule,
    /// The length of each simulation under one constant pattern, in env steps.
    pub fixed_steps: u32,
    /// The archive's axes.
    pub descriptors: Vec<Axis>,
    /// Offspring of archived parents in each generation.
    pub batch: usize,
    /// Fresh random bodies added in each generation.
    pub newcomers: usize,
    /// Generations.
    pub generations: u32,
    /// One run for each seed.
    pub seeds: Vec<u64>,
    /// Where the paper's text and the authors' code differ, which of them holds.
    pub rules: Rules,
    /// What is rewarded.
    pub objective: Objective,
    /// What one evaluation may fill.
    pub symmetry: Symmetry,
    /// What a niche keeps.
    pub niche: Niche,
}

/// Which reading of the paper holds where its text and its code differ (docs/physics.md 11).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Rules {
    /// As the paper's text says.
    #[default]
    Paper,
    /// As the authors' code does.
    Code,
}

/// One axis of an archive.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Axis {
    /// A number of voxels, in that many bins.
    Count {
        /// What is counted.
        of: Count,
        /// Bins.
        bins: usize,
    },
    /// The sixteen behaviors.
    Behavior,
}

/// What a count axis counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Count {
    /// All voxels.
    Voxels,
    /// Actuators.
    Active,
    /// Sensors.
    Sensory,
}

/// How often each mutation operator is drawn, as weights (docs/physics.md 11).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MutationWeights {
    /// Put a node into a link.
    pub add_node: f64,
    /// Take a node out and bridge it.
    pub remove_node: f64,
    /// Add a link.
    pub add_link: f64,
    /// Remove a link.
    pub remove_link: f64,
    /// Give a node another activation.
    pub change_activation: f64,
    /// Move a weight.
    pub change_weight: f64,
}

impl Default for MutationWeights {
    /// All alike, as in the paper.
    fn default() -> Self {
        Self {
            add_node: 1.0,
            remove_node: 1.0,
            add_link: 1.0,
            remove_link: 1.0,
            change_activation: 1.0,
            change_weight: 1.0,
        }
    }
}

/// What an evolution run rewards.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Objective {
    /// The paper's two: distance in the variable simulation, least distance in the fixed ones.
    #[default]
    Distance,
    /// Being right in every cycle of random sequences, with the shortest clock.
    Gate,
}

/// What one evaluation may fill.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Symmetry {
    /// The body's own niche.
    #[default]
    None,
    /// The niches of all bodies that follow by exchanging and inverting inputs and by mirroring.
    Npn,
}

/// What a niche keeps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Niche {
    /// One elite, replaced by what is better in both fitnesses.
    #[default]
    Dominance,
    /// A Pareto set of at most that many.
    Pareto(usize),
}
