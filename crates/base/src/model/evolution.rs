//! Evolution runs as declared data.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::{Behavior, Function, Palette, PhysicsWorld, Rules, Schedule, SearchObjective, Variation};

/// A declared evolution run (paper, Methods).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Evolution {
    /// The name of the declaration.
    pub name: String,
    /// Columns of the bounding box, in voxels.
    pub width: usize,
    /// Rows of the bounding box, in voxels.
    pub height: usize,
    /// The materials a body may use.
    pub palette: Arc<Palette>,
    /// What bodies are made from.
    #[serde(default, skip_serializing_if = "Genome::is_cppn")]
    pub genome: Genome,
    /// The robots with which a search of voxels begins.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<StartBodies>,
    /// The weights of the mutation operators of networks.
    pub mutation: MutationWeights,
    /// The stimuli of the long simulation, in which they change (paper, Methods); or the images that are told apart,
    /// each with the number of its set as its pattern.
    pub variable: Schedule,
    /// How images follow each other.
    #[serde(default, skip_serializing_if = "ImageOrder::is_apart")]
    pub shown: ImageOrder,
    /// The length of each simulation under one constant pattern, in env steps.
    pub fixed_steps: u32,
    /// The axes of the archive; a niche is one bin of each.
    pub descriptors: Vec<Axis>,
    /// Offspring of archived parents in each generation.
    pub batch: usize,
    /// Fresh random bodies added in each generation.
    pub newcomers: usize,
    /// The number of generations of a run.
    pub generations: u32,
    /// The seeds of the runs, one run for each.
    pub seeds: Vec<u64>,
    /// In what to follow the authors' code where the paper's text differs.
    pub rules: Rules,
    /// What makes a body better than another in its niche.
    pub objective: SearchObjective,
    /// The behaviors that gates are searched for: a body is scored as the one that it comes nearest to. If there are
    /// none, it is scored as what it does.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub behaviors: Vec<Behavior>,
    /// The niches that one evaluation may enter.
    pub symmetry: Symmetry,
    /// The elites that a niche keeps.
    pub niche: Niche,
    /// The world in which bodies are evaluated.
    #[serde(default, skip_serializing_if = "PhysicsWorld::is_paper")]
    pub world: PhysicsWorld,
    /// Other worlds in which bodies must work too.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sample: Option<SampledWorlds>,
}

/// Worlds around that of an evolution, in which the gate objective tries every body too.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SampledWorlds {
    /// The number of worlds, at least 1.
    pub worlds: u32,
    /// The largest change of each of their quantities.
    pub vary: Variation,
}

impl SampledWorlds {
    /// The most worlds that a declaration may ask for.
    pub const MOST: u32 = 1000;
    /// The number of worlds if it is not declared.
    pub const USUAL: u32 = 4;
}

/// What bodies are made from, and what mutations change.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Genome {
    /// A network that gives each place its material, as in the paper.
    #[default]
    Cppn,
    /// The voxels themselves.
    Voxels {
        /// The share of offspring that take a part of a second parent, from 0 to 1.
        crossover: f64,
    },
}

impl Genome {
    /// Whether it is the paper's.
    pub fn is_cppn(&self) -> bool {
        *self == Self::Cppn
    }
}

/// How the images of an evolution follow each other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ImageOrder {
    /// Each of them from a fresh start.
    #[default]
    Apart,
    /// One after another, without a reset between them.
    InTurn,
}

impl ImageOrder {
    /// Both, with their names in a declaration.
    pub const ALL: [(&str, Self); 2] = [("apart", Self::Apart), ("in_turn", Self::InTurn)];

    /// Whether each image has a fresh start.
    pub fn is_apart(&self) -> bool {
        *self == Self::Apart
    }
}

/// The bodies of a library, with which a search begins.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StartBodies {
    /// The declared library.
    pub library: String,
    /// The rows of those of its robots that fit into the box, in the codes of the run; empty until they are read.
    pub bodies: Vec<Vec<String>>,
}

/// One axis of an archive.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Axis {
    /// A number of voxels, divided into bins.
    Count {
        /// The kind of voxels.
        of: Count,
        /// The number of bins.
        bins: usize,
    },
    /// The behaviors, a bin for each: sixteen of two stimuli, 256 of three.
    Behavior,
    /// The classes of behaviors under inverting and exchanging stimuli and mirroring. The bin of a class is the lowest
    /// bits of its functions.
    Class,
}

impl Axis {
    /// The number of bins that bodies with that many inputs can be in.
    ///
    /// # Panics
    /// When there are neither two nor three inputs.
    pub fn bins(&self, inputs: usize) -> usize {
        match *self {
            Self::Count { bins, .. } => bins,
            Self::Behavior => Function::all_of(inputs).count(),
            Self::Class => Function::all_of(inputs).filter(|function| function.class()[0] == *function).count(),
        }
    }
}

/// The kind of voxels on a count axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Count {
    /// Voxels of any material.
    Voxels,
    /// Voxels of actuators.
    Active,
    /// Voxels of sensors.
    Sensory,
}

/// The weights of the mutation operators: an operator is drawn with a probability in proportion to its weight
/// (docs/physics.md 11).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MutationWeights {
    /// Add a node on a link.
    pub add_node: f64,
    /// Remove a node and bridge it.
    pub remove_node: f64,
    /// Add a link.
    pub add_link: f64,
    /// Remove a link.
    pub remove_link: f64,
    /// Change the activation of a node.
    pub change_activation: f64,
    /// Change a weight.
    pub change_weight: f64,
}

impl Default for MutationWeights {
    /// Equal weights, as in the paper.
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
    /// Only the niche of the body itself.
    #[default]
    None,
    /// The niches of all bodies that follow by exchanging and inverting inputs and by mirroring.
    Npn,
}

/// The elites that a niche keeps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Niche {
    /// One elite, replaced by a body that is better in both fitnesses.
    #[default]
    Dominance,
    /// A Pareto set of at most this size.
    Pareto(usize),
}
