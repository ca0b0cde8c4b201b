//! The ways to learn an output from rows, each advanced in portions.

use std::fmt;

use crate::arithmetic::entry;
use crate::bits::Bits;
use crate::cubes::Cubes;
use crate::examples::OutputRows;
use crate::forest::Forest;
use crate::graph::{GateGraph, Literal};
use crate::recognize;
use crate::tree::{DecisionTree, Feature, Growth, add_fringe};

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LearningMethod {
    Constant,
    Parity,
    Count,
    Arithmetic,
    Chain,
    /// A multiplexer for each input and value of the inputs before, if all values are there.
    Table,
    /// Two-level logic of the rows with ones, or with zeros; each cube has at least so many rows.
    Cubes {
        ones: bool,
        least: usize,
    },
    /// A decision tree with at least `leaf` rows on each side of a question, and so many rounds of features of pairs.
    Tree {
        leaf: usize,
        fringes: usize,
    },
    Forest {
        trees: usize,
        depth: usize,
        fringes: usize,
    },
}

impl LearningMethod {
    /// All that are tried, the cheap ones first.
    pub fn all() -> Vec<Self> {
        let mut all = vec![Self::Constant, Self::Parity, Self::Count, Self::Arithmetic, Self::Chain, Self::Table];
        for (ones, least) in [(true, 1), (false, 1), (true, 3), (false, 3)] {
            all.push(Self::Cubes { ones, least });
        }
        for fringes in [0, FRINGES] {
            all.extend([1, 4, MOST_LEAF].map(|leaf| Self::Tree { leaf, fringes }));
        }
        for (trees, depth) in [(7, 4), (15, 3), (7, 7), (15, 5), (31, 4), (15, 7), (31, 6), (63, 4)] {
            all.push(Self::Forest { trees, depth, fringes: 0 });
        }
        all.push(Self::Forest { trees: 15, depth: 5, fringes: FRINGES });
        all
    }

    /// A smaller tree than this one, or than all candidates; `None` if it would have no question for so many rows.
    pub fn smaller_tree(self, rows: usize) -> Option<Self> {
        let leaf = if let Self::Tree { leaf, .. } = self { 2 * leaf } else { 2 * MOST_LEAF };
        (2 * leaf <= rows).then_some(Self::Tree { leaf, fringes: 0 })
    }

    /// Whether it grows gates from rows, so that their number depends on how far it grows.
    pub fn is_grown(self) -> bool {
        matches!(self, Self::Cubes { .. } | Self::Tree { .. } | Self::Forest { .. })
    }

    /// Whether it recognizes a function: if that is right in all rows, nothing else is tried.
    pub fn is_recognition(self) -> bool {
        matches!(self, Self::Parity | Self::Count | Self::Arithmetic | Self::Chain)
    }
}

/// The smallest of the trees that are always tried has at least so many rows on each side of a question.
const MOST_LEAF: usize = 12;

const FRINGES: usize = 6;

const MOST_FEATURES: usize = 1_000;

const FOREST_LEAF: f64 = 3.0;

impl fmt::Display for LearningMethod {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constant => f.write_str("a constant"),
            Self::Parity => f.write_str("a parity"),
            Self::Count => f.write_str("a function of the number of ones"),
            Self::Arithmetic => f.write_str("a bit of arithmetic"),
            Self::Chain => f.write_str("a chain of majorities"),
            Self::Table => f.write_str("a table of all inputs"),
            Self::Cubes { ones, least } => {
                write!(f, "two-level logic of the {}", if *ones { "ones" } else { "zeros" })?;
                if *least > 1 { write!(f, ", {least} rows a cube or more") } else { Ok(()) }
            }
            Self::Tree { leaf, fringes } => {
                let pairs = if *fringes > 0 { " with features of pairs" } else { "" };
                write!(f, "a decision tree{pairs}, {leaf} rows a leaf or more")
            }
            Self::Forest { trees, depth, fringes } => {
                let pairs = if *fringes > 0 { " with features of pairs" } else { "" };
                write!(f, "{trees} trees of depth {depth}{pairs}")
            }
        }
    }
}

#[derive(Clone, Debug)]
pub struct Fitting {
    method: LearningMethod,
    graph: GateGraph,
    features: Vec<Feature>,
    fringes: usize,
    forest: Option<Forest>,
}

#[derive(Clone, Debug)]
pub struct Fitted {
    pub graph: GateGraph,
    pub literal: Literal,
    pub what: String,
}

pub enum FittingStep {
    More,
    /// It is done; `None` if the method finds nothing in such rows.
    Done(Option<Fitted>),
}

impl Fitting {
    pub fn new(method: LearningMethod, inputs: &[Bits]) -> Self {
        let graph = GateGraph::new(inputs.len());
        let features = Feature::of_inputs(&graph, inputs);
        Self { method, graph, features, fringes: 0, forest: None }
    }

    pub fn method(&self) -> LearningMethod {
        self.method
    }

    pub fn advance(&mut self, subject: &OutputRows) -> FittingStep {
        let OutputRows { inputs, target } = subject;
        let found = match self.method {
            LearningMethod::Constant => return FittingStep::Done(Some(Fitted::most(subject))),
            LearningMethod::Parity => recognize::parity(&mut self.graph, inputs, target),
            LearningMethod::Count => Some(recognize::of_count(&mut self.graph, inputs, target)),
            LearningMethod::Arithmetic => recognize::arithmetic(&mut self.graph, inputs, target),
            LearningMethod::Chain => recognize::chain(&mut self.graph, inputs, target),
            LearningMethod::Table => {
                let word: Vec<Literal> = self.graph.inputs();
                let what = self.method.to_string();
                subject.table().map(|table| (entry(&mut self.graph, &word, &table), what))
            }
            LearningMethod::Cubes { ones, least } => {
                let wanted = if ones { target.clone() } else { target.not() };
                let sum = Cubes::grow(&self.features, &wanted, least).build(&mut self.graph, &self.features);
                Some((sum.inverted_if(!ones), self.method.to_string()))
            }
            LearningMethod::Tree { leaf, fringes } => {
                let tree = self.tree(target, leaf as f64);
                if self.widen(&tree, fringes) {
                    return FittingStep::More;
                }
                Some((tree.build(&mut self.graph, &self.features), self.method.to_string()))
            }
            LearningMethod::Forest { trees, depth, fringes } => {
                if self.forest.is_none() && fringes > 0 {
                    let tree = self.tree(target, FOREST_LEAF);
                    if self.widen(&tree, fringes) {
                        return FittingStep::More;
                    }
                }
                let growth = Growth { depth, leaf: FOREST_LEAF };
                let forest = self.forest.get_or_insert_with(|| Forest::new(target.rows(), growth));
                forest.grow(&self.features, target);
                if forest.len() < trees {
                    return FittingStep::More;
                }
                Some((forest.build(&mut self.graph, &self.features), self.method.to_string()))
            }
        };
        FittingStep::Done(found.map(|(literal, what)| Fitted { graph: std::mem::take(&mut self.graph), literal, what }))
    }

    fn tree(&self, target: &Bits, leaf: f64) -> DecisionTree {
        let growth = Growth { depth: usize::MAX, leaf };
        DecisionTree::grow(&self.features, target, &vec![1.0; target.rows()], growth)
    }

    /// Adds features of a tree's fringe, so often at most; false if there is nothing to add.
    fn widen(&mut self, tree: &DecisionTree, fringes: usize) -> bool {
        if self.fringes == fringes || self.features.len() >= MOST_FEATURES {
            return false;
        }
        self.fringes += 1;
        add_fringe(&mut self.graph, &mut self.features, tree)
    }
}

impl Fitted {
    pub fn constant(inputs: usize, value: bool) -> Self {
        let literal = Literal::constant(value);
        Self { graph: GateGraph::new(inputs), literal, what: LearningMethod::Constant.to_string() }
    }

    pub fn most(OutputRows { inputs, target }: &OutputRows) -> Self {
        Self::constant(inputs.len(), target.count() * 2 > target.rows())
    }

    pub fn accuracy(&self, rows: &OutputRows) -> f64 {
        1.0 - self.wrong(rows) as f64 / rows.target.rows().max(1) as f64
    }

    pub fn wrong(&self, OutputRows { inputs, target }: &OutputRows) -> usize {
        self.graph.values(inputs, &[self.literal])[0].xor(target).count()
    }

    pub fn ands(&self) -> usize {
        self.graph.ands(&[self.literal])
    }
}
