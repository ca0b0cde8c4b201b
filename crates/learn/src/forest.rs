//! Small forests: trees that are grown one after another on the rows that those before get wrong, and their majority.

use crate::arithmetic::majority;
use crate::bits::Bits;
use crate::graph::{GateGraph, Literal};
use crate::tree::{DecisionTree, Feature, Growth};

#[derive(Clone, Debug)]
pub struct Forest {
    growth: Growth,
    /// How many more trees voted right than wrong, for each row.
    margins: Vec<f64>,
    trees: Vec<DecisionTree>,
}

/// How much less a row weighs after each right vote. All votes are equal (the constant step of ε-boosting).
const STEP: f64 = 0.3;

impl Forest {
    pub fn new(rows: usize, growth: Growth) -> Self {
        Self { growth, margins: vec![0.0; rows], trees: Vec::new() }
    }

    pub fn grow(&mut self, features: &[Feature], target: &Bits) {
        let weights = weights(&self.margins, STEP);
        let tree = DecisionTree::grow(features, target, &weights, self.growth);
        let wrong = tree.answers(features, target.rows()).xor(target);
        count_votes(&mut self.margins, &wrong, 1.0);
        self.trees.push(tree);
    }

    pub fn len(&self) -> usize {
        self.trees.len()
    }

    pub fn build(&self, graph: &mut GateGraph, features: &[Feature]) -> Literal {
        let votes: Vec<Literal> = self.trees.iter().map(|tree| tree.build(graph, features)).collect();
        majority(graph, &votes)
    }
}

/// The weights of rows, 1 on average; `margins` says how many more votes for a row were right than wrong.
pub fn weights(margins: &[f64], step: f64) -> Vec<f64> {
    let weights: Vec<f64> = margins.iter().map(|margin| libm::exp(-step * margin)).collect();
    let scale = weights.len() as f64 / weights.iter().sum::<f64>();
    weights.into_iter().map(|weight| weight * scale).collect()
}

pub fn count_votes(margins: &mut [f64], wrong: &Bits, times: f64) {
    for (row, margin) in margins.iter_mut().enumerate() {
        *margin += if wrong.get(row) { -times } else { times };
    }
}
