//! Genotypes: compositional pattern-producing networks as plain data; `evolve` has the operations on them.

use serde::{Deserialize, Serialize};

/// The number of a node, unique within its genotype.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct NodeId(pub u32);

/// A network from the position of a voxel to a score for each material code (paper, Methods; docs/physics.md 11).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Genotype {
    /// The inputs, an output for each code, then the hidden nodes, by number. Of equal scores, the first output wins.
    pub nodes: Vec<(NodeId, NodeKind)>,
    /// The links in order of insertion, which is the order of summation.
    pub links: Vec<Link>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum NodeKind {
    /// An input: x, y, z, distance or bias, in this order.
    Input(u8),
    Output(u8, Activation),
    Hidden(Activation),
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Link {
    pub source: NodeId,
    pub target: NodeId,
    pub weight: f64,
}

/// The function from the sum `u` of the weighted inputs of a node to its output.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Activation {
    Sine,
    Abs,
    NegAbs,
    Square,
    NegSquare,
    SqrtAbs,
    NegSqrtAbs,
    /// 2 / (1 + e^-u) - 1, the initial activation of outputs
    Sigmoid,
}
