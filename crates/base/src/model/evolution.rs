//! Evolution runs as declared data.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::{
    Behavior, Function, Image, Palette, Pattern, PhysicsWorld, Rules, Schedule, SearchObjective, Spell, Variation,
};

/// A declared evolution run (paper, Methods).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Evolution {
    pub name: String,
    /// Columns and rows of the bounding box, in voxels.
    pub width: usize,
    pub height: usize,
    pub palette: Arc<Palette>,
    #[serde(default, skip_serializing_if = "Genome::is_cppn")]
    pub genome: Genome,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<StartBodies>,
    pub mutation: MutationWeights,
    /// Of the long simulation (paper, Methods); or the images that are told apart, with their sets as patterns.
    pub variable: Schedule,
    #[serde(default, skip_serializing_if = "ImageOrder::is_apart")]
    pub shown: ImageOrder,
    /// The length of each simulation under one constant pattern, in env steps.
    pub fixed_steps: u32,
    /// The axes of the archive; a niche is one bin of each.
    pub descriptors: Vec<Axis>,
    pub batch: usize,
    pub newcomers: usize,
    pub generations: u32,
    pub seeds: Vec<u64>,
    pub rules: Rules,
    pub objective: SearchObjective,
    /// A body is scored as the one that it comes nearest to; if there are none, as what it does.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub behaviors: Vec<Behavior>,
    pub symmetry: Symmetry,
    pub niche: Niche,
    #[serde(default, skip_serializing_if = "PhysicsWorld::is_paper")]
    pub world: PhysicsWorld,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sample: Option<SampledWorlds>,
}

impl Evolution {
    /// The first image of each set that bodies are shown; none of other objectives.
    pub fn images(&self) -> Vec<Arc<Image>> {
        let mut first: BTreeMap<Pattern, Arc<Image>> = BTreeMap::new();
        for Spell { pattern, image, .. } in &self.variable.spells {
            if let Some(image) = image {
                first.entry(*pattern).or_insert_with(|| Arc::clone(image));
            }
        }
        first.into_values().collect()
    }
}

/// Worlds around that of an evolution, in which the gate objective tries every body too.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SampledWorlds {
    /// The number of worlds, at least 1.
    pub worlds: u32,
    pub vary: Variation,
}

impl SampledWorlds {
    pub const MOST: u32 = 1000;
    pub const USUAL: u32 = 4;
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Genome {
    #[default]
    Cppn,
    Voxels {
        /// The share of offspring that take a part of a second parent, from 0 to 1.
        crossover: f64,
    },
}

impl Genome {
    pub fn is_cppn(&self) -> bool {
        *self == Self::Cppn
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ImageOrder {
    #[default]
    Apart,
    /// One after another, without a reset between them.
    InTurn,
}

impl ImageOrder {
    pub const ALL: [(&str, Self); 2] = [("apart", Self::Apart), ("in_turn", Self::InTurn)];

    pub fn is_apart(&self) -> bool {
        *self == Self::Apart
    }
}

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StartBodies {
    pub library: String,
    /// The rows of those of its robots that fit into the box, in the codes of the run; empty until they are read.
    pub bodies: Vec<Vec<String>>,
}

/// One axis of an archive.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Axis {
    /// A number of voxels, divided into bins.
    Count { of: Count, bins: usize },
    /// The behaviors, a bin for each: sixteen of two stimuli, 256 of three.
    Behavior,
    /// The classes of behaviors under inverting and exchanging stimuli and mirroring. The bin of a class is the lowest
    /// bits of its functions.
    Class,
}

impl Axis {
    pub fn bins(&self, inputs: usize) -> usize {
        match *self {
            Self::Count { bins, .. } => bins,
            Self::Behavior => Function::all_of(inputs).count(),
            Self::Class => Function::all_of(inputs).filter(|function| function.class()[0] == *function).count(),
        }
    }

    pub fn word(self) -> &'static str {
        match self {
            Self::Count { of: Count::Voxels, .. } => "voxels",
            Self::Count { of: Count::Active, .. } => "active",
            Self::Count { of: Count::Sensory, .. } => "sensory",
            Self::Behavior => "behavior",
            Self::Class => "class",
        }
    }
}

/// The kind of voxels on a count axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Count {
    Voxels,
    Active,
    Sensory,
}

/// The weights of the mutation operators: an operator is drawn with a probability in proportion to its weight
/// (docs/physics.md 11).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MutationWeights {
    pub add_node: f64,
    pub remove_node: f64,
    pub add_link: f64,
    pub remove_link: f64,
    pub change_activation: f64,
    pub change_weight: f64,
}

impl Default for MutationWeights {
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

/// The niches that one evaluation may enter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Symmetry {
    #[default]
    None,
    /// The niches of all bodies that follow by exchanging and inverting inputs and by mirroring.
    Npn,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Niche {
    /// One elite, replaced by a body that is better in both fitnesses.
    #[default]
    Dominance,
    Pareto(usize),
}
