//! Decision trees: a multiplexer for each question.

use std::collections::BTreeMap;

use crate::bits::Bits;
use crate::graph::{GateGraph, Literal};

const MOST_DEPTH: usize = 48;

#[derive(Clone, Debug)]
pub struct Feature {
    pub literal: Literal,
    pub bits: Bits,
}
impl Feature {
    pub fn of_inputs(graph: &GateGraph, inputs: &[Bits]) -> Vec<Self> {
        let feature = |(literal, bits): (Literal, &Bits)| Self { literal, bits: bits.clone() };
        graph.inputs().into_iter().zip(inputs).map(feature).collect()
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Growth {
    pub depth: usize,
    /// The least weight of rows on each side of a question.
    pub leaf: f64,
}

#[derive(Clone, Debug, PartialEq)]
pub enum DecisionTree {
    /// An answer, with the weight of the rows that come there.
    Leaf(bool, f64),
    Split(usize, Box<DecisionTree>, Box<DecisionTree>),
}

impl DecisionTree {
    pub fn grow(features: &[Feature], target: &Bits, weights: &[f64], growth: Growth) -> Self {
        let rows: Vec<usize> = (0..target.rows()).filter(|&row| weights[row] > 0.0).collect();
        Self::of_rows(features, target, weights, Growth { depth: growth.depth.min(MOST_DEPTH), ..growth }, &rows)
    }

    fn of_rows(features: &[Feature], target: &Bits, weights: &[f64], growth: Growth, rows: &[usize]) -> Self {
        let (mut all, mut ones) = (0.0, 0.0);
        for &row in rows {
            all += weights[row];
            ones += if target.get(row) { weights[row] } else { 0.0 };
        }
        let leaf = Self::Leaf(ones * 2.0 > all, all);
        if growth.depth == 0 || ones == 0.0 || ones == all || all < 2.0 * growth.leaf {
            return leaf;
        }
        let Some(feature) = best_split(features, target, weights, growth.leaf, rows, (all, ones)) else { return leaf };
        let (yes, no): (Vec<usize>, Vec<usize>) = rows.iter().partition(|&&row| features[feature].bits.get(row));
        let below = Growth { depth: growth.depth - 1, ..growth };
        let [yes, no] = [yes, no].map(|rows| Self::of_rows(features, target, weights, below, &rows));
        match (&yes, &no) {
            (Self::Leaf(one, _), Self::Leaf(two, _)) if one == two => leaf,
            _ => Self::Split(feature, Box::new(yes), Box::new(no)),
        }
    }

    pub fn answers(&self, features: &[Feature], rows: usize) -> Bits {
        match self {
            Self::Leaf(answer, _) => Bits::all(rows, *answer),
            Self::Split(feature, yes, no) => {
                let select = &features[*feature].bits;
                select.and(&yes.answers(features, rows)).or(&no.answers(features, rows).and_not(select))
            }
        }
    }

    pub fn build(&self, graph: &mut GateGraph, features: &[Feature]) -> Literal {
        match self {
            Self::Leaf(answer, _) => Literal::constant(*answer),
            Self::Split(feature, yes, no) => {
                let (yes, no) = (yes.build(graph, features), no.build(graph, features));
                graph.mux(features[*feature].literal, yes, no)
            }
        }
    }

    /// The pairs of questions just before answers, by the weight of the rows that they decide: for each, the features
    /// with the answers that lead there, or both features if it is their exclusive or.
    fn fringe(&self, above: Option<(usize, bool)>, found: &mut BTreeMap<Pair, f64>) {
        let Self::Split(feature, yes, no) = self else { return };
        for (side, tree) in [(true, yes), (false, no)] {
            match &**tree {
                Self::Leaf(_, weight) => {
                    if let Some((before, answer)) = above {
                        *found.entry(Pair::both((before, answer), (*feature, side))).or_default() += weight;
                    }
                }
                inner => inner.fringe(Some((*feature, side)), found),
            }
        }
        if let (Self::Split(one, a, b), Self::Split(two, c, d)) = (&**yes, &**no)
            && one == two
            && let (Self::Leaf(a, wa), Self::Leaf(b, wb), Self::Leaf(c, wc), Self::Leaf(d, wd)) =
                (&**a, &**b, &**c, &**d)
            && a == d
            && b == c
        {
            *found.entry(Pair::differ(*feature, *one)).or_default() += wa + wb + wc + wd;
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Pair {
    Both((usize, bool), (usize, bool)),
    Differ(usize, usize),
}

impl Pair {
    fn both(one: (usize, bool), two: (usize, bool)) -> Self {
        Self::Both(one.min(two), one.max(two))
    }

    fn differ(one: usize, two: usize) -> Self {
        Self::Differ(one.min(two), one.max(two))
    }
}

fn best_split(
    features: &[Feature],
    target: &Bits,
    weights: &[f64],
    leaf: f64,
    rows: &[usize],
    (all, ones): (f64, f64),
) -> Option<usize> {
    let impurity = |all: f64, ones: f64| ones * (all - ones) / all;
    let mut best: Option<(f64, usize)> = None;
    for (at, feature) in features.iter().enumerate() {
        let (mut weight, mut set) = (0.0, 0.0);
        for &row in rows {
            if feature.bits.get(row) {
                weight += weights[row];
                set += if target.get(row) { weights[row] } else { 0.0 };
            }
        }
        if weight < leaf || all - weight < leaf || weight <= 0.0 || weight >= all {
            continue;
        }
        let left = impurity(weight, set) + impurity(all - weight, ones - set);
        if best.is_none_or(|(least, _)| left < least) {
            best = Some((left, at));
        }
    }
    best.map(|(_, at)| at)
}

const ADDED: usize = 64;

/// Adds features for pairs of questions at the fringe of a tree, such as the exclusive or of two features (Pagallo and
/// Haussler 1990): a tree that has to ask for both again and again then asks once. Returns whether any is new.
pub fn add_fringe(graph: &mut GateGraph, features: &mut Vec<Feature>, tree: &DecisionTree) -> bool {
    let mut found = BTreeMap::new();
    tree.fringe(None, &mut found);
    let mut pairs: Vec<(Pair, f64)> = found.into_iter().collect();
    pairs.sort_by(|one, two| two.1.total_cmp(&one.1));
    let known = |features: &[Feature], literal: Literal| {
        features.iter().any(|feature| feature.literal == literal || feature.literal == !literal)
    };
    let before = features.len();
    for (pair, _) in pairs.into_iter().take(ADDED) {
        let (literal, bits) = match pair {
            Pair::Both((one, a), (two, b)) => {
                let [one, two] = [&features[one], &features[two]];
                let side =
                    |feature: &Feature, value: bool| if value { feature.bits.clone() } else { feature.bits.not() };
                let literal = graph.and(one.literal.inverted_if(!a), two.literal.inverted_if(!b));
                (literal, side(one, a).and(&side(two, b)))
            }
            Pair::Differ(one, two) => {
                let [one, two] = [&features[one], &features[two]];
                (graph.xor(one.literal, two.literal), one.bits.xor(&two.bits))
            }
        };
        if !known(features, literal) {
            features.push(Feature { literal, bits });
        }
    }
    features.len() > before
}
