//! Small forests: trees that are grown one after another on the rows that those before get wrong, and their majority.

use crate::arithmetic::count;
use crate::bits::Bits;
use crate::graph::{GateGraph, Literal};
use crate::tree::{DecisionTree, Feature, Growth};

/// Trees that vote with the same weight.
#[derive(Clone, Debug)]
pub struct Forest {
    growth: Growth,
    /// How many more trees voted right than wrong, for each row.
    margins: Vec<f64>,
    trees: Vec<DecisionTree>,
}

/// How much less a row weighs after each right vote. All votes are equal, so that a majority counts them (the constant
/// step of ε-boosting).
const STEP: f64 = 0.3;

impl Forest {
    /// A forest without trees.
    pub fn new(rows: usize, growth: Growth) -> Self {
        Self { growth, margins: vec![0.0; rows], trees: Vec::new() }
    }

    /// Grows a tree more.
    pub fn grow(&mut self, features: &[Feature], target: &Bits) {
        let weights: Vec<f64> = self.margins.iter().map(|margin| libm::exp(-STEP * margin)).collect();
        let scale = weights.len() as f64 / weights.iter().sum::<f64>();
        let weights: Vec<f64> = weights.into_iter().map(|weight| weight * scale).collect();
        let tree = DecisionTree::grow(features, target, &weights, self.growth);
        let wrong = tree.answers(features, target.rows()).xor(target);
        for (row, margin) in self.margins.iter_mut().enumerate() {
            *margin += if wrong.get(row) { -1.0 } else { 1.0 };
        }
        self.trees.push(tree);
    }

    /// The number of trees.
    pub fn len(&self) -> usize {
        self.trees.len()
    }

    /// The majority of the trees as gates. Their number is one less than a power of two, so that it is the highest bit
    /// of their count.
    pub fn build(&self, graph: &mut GateGraph, features: &[Feature]) -> Literal {
        assert!((self.trees.len() + 1).is_power_of_two(), "the highest bit of the count is the majority");
        let votes: Vec<Literal> = self.trees.iter().map(|tree| tree.build(graph, features)).collect();
        *count(graph, &votes).last().expect("a count has a bit")
    }
}
