//! Genotypes: compositional pattern-producing networks as plain data; what is done to them is in `evolve`.

use serde::{Deserialize, Serialize};

/// A node's number, unique within its genotype.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct NodeId(pub u32);

/// A network from a voxel's place to a score for each material code (paper, Methods; docs/physics.md 11).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Genotype {
    /// The nodes: the inputs, an output for each code, then the hidden ones, in order of their numbers. Of equal scores the output
    /// that comes first wins.
    pub nodes: Vec<(NodeId, NodeKind)>,
    /// The links in order of insertion, which is the order of summation.
    pub links: Vec<Link>,
}

/// What a node is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum NodeKind {
    /// An input: x, y, z, distance or bias, in this order.
    Input(u8),
    /// The score of a material code, with its activation.
    Output(u8, Activation),
    /// A hidden node with its activation.
    Hidden(Activation),
}

/// A weighted link.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Link {
    /// Where the value comes from.
    pub source: NodeId,
    /// Where it goes.
    pub target: NodeId,
    /// What it is multiplied by.
    pub weight: f64,
}

/// A node's activation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Activation {
    /// sin u
    Sine,
    /// |u|
    Abs,
    /// -|u|
    NegAbs,
    /// u²
    Square,
    /// -u²
    NegSquare,
    /// sqrt |u|
    SqrtAbs,
    /// -sqrt |u|
    NegSqrtAbs,
    /// 2 / (1 + e^-u) - 1, where outputs start
    Sigmoid,
}
