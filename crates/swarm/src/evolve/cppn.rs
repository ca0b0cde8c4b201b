//! Compositional pattern-producing networks: the starting network, and its scores over a bounding box (docs/physics.md
//! 11).

use nbc_base::model::{Activation, Genotype, Link, Matter, NodeId, NodeKind, Rules};

/// Inputs of a network: x, y (row), z (column), distance, bias.
const INPUTS: u8 = 5;
pub(crate) const COLUMN: u8 = 2;

/// The score of one material code at each place of the box, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct ScoreMap {
    /// The material code, 0 for empty.
    pub code: u8,
    pub scores: Vec<f64>,
}

/// The network that every search starts from: each input linked to each output with weight 0, no hidden nodes.
/// `materials` is the size of the palette. By the paper's text there is no input for an axis of length 1.
pub fn start(materials: usize, rules: Rules) -> Genotype {
    let first = if rules.follow_code(Matter::Depth) { 0 } else { 1 };
    let inputs = (first..INPUTS).map(NodeKind::Input);
    let outputs = (0..=materials as u8).map(|code| NodeKind::Output(code, Activation::Sigmoid));
    let nodes: Vec<_> = (0..).map(NodeId).zip(inputs.chain(outputs)).collect();
    let is_input = |kind: &NodeKind| matches!(kind, NodeKind::Input(_));
    let mut links = Vec::new();
    for &(source, _) in nodes.iter().filter(|(_, kind)| is_input(kind)) {
        for &(target, _) in nodes.iter().filter(|(_, kind)| !is_input(kind)) {
            links.push(Link { source, target, weight: 0.0 });
        }
    }
    Genotype { nodes, links }
}

/// The scores of all codes over a box of `width` columns and `height` rows, in the order of the network's outputs.
pub fn scores(genotype: &Genotype, rules: Rules, width: usize, height: usize) -> Vec<ScoreMap> {
    let mut run = Run::new(genotype, rules, width, height);
    let outputs = genotype.nodes.iter().enumerate().filter_map(|(at, &(_, kind))| match kind {
        NodeKind::Output(code, _) => Some((at, code)),
        _ => None,
    });
    outputs.map(|(at, code)| ScoreMap { code, scores: run.output(at) }).collect()
}

pub fn activate(activation: Activation, u: f64) -> f64 {
    match activation {
        Activation::Sine => libm::sin(u),
        Activation::Abs => u.abs(),
        Activation::NegAbs => -u.abs(),
        Activation::Square => u * u,
        Activation::NegSquare => -(u * u),
        Activation::SqrtAbs => u.abs().sqrt(),
        Activation::NegSqrtAbs => -u.abs().sqrt(),
        Activation::Sigmoid => 2.0 / (1.0 + libm::exp(-u)) - 1.0,
    }
}

struct Run<'a> {
    genotype: &'a Genotype,
    rules: Rules,
    inputs: Vec<Vec<f64>>,
    /// The links to each node in their order: the index of the source, and the weight.
    sources: Vec<Vec<(usize, f64)>>,
    remembered: Vec<Option<Vec<f64>>>,
    /// The nodes being computed. A node that needs one of them is on a cycle, which only a damaged file can contain.
    open: Vec<bool>,
}

impl<'a> Run<'a> {
    fn new(genotype: &'a Genotype, rules: Rules, width: usize, height: usize) -> Self {
        let nodes = genotype.nodes.len();
        let at = |wanted: NodeId| genotype.nodes.iter().position(|&(id, _)| id == wanted);
        let mut sources = vec![Vec::new(); nodes];
        for link in &genotype.links {
            if let (Some(source), Some(target)) = (at(link.source), at(link.target)) {
                sources[target].push((source, link.weight));
            }
        }
        let inputs = inputs(rules, width, height);
        Self { genotype, rules, inputs, sources, remembered: vec![None; nodes], open: vec![false; nodes] }
    }

    /// The map of the output at index `at`. In the authors' code, an output that an earlier one reads is 0 everywhere.
    fn output(&mut self, at: usize) -> Vec<f64> {
        let taken = self.rules.follow_code(Matter::Outputs) && self.remembered[at].is_some();
        let mut map = self.zeros();
        if !taken {
            self.give(at, |value, map| *map = value, &mut map);
        }
        self.remembered[at] = Some(map.clone());
        map
    }

    fn give(&mut self, at: usize, take: impl Fn(f64, &mut f64), to: &mut [f64]) {
        let pass = |values: &[f64], to: &mut [f64]| values.iter().zip(to).for_each(|(&value, to)| take(value, to));
        let activation = match self.genotype.nodes[at].1 {
            NodeKind::Input(input) => match self.inputs.get(usize::from(input)) {
                Some(values) => return pass(values, to),
                None => return pass(&self.zeros(), to),
            },
            NodeKind::Output(_, activation) | NodeKind::Hidden(activation) => activation,
        };
        if let Some(values) = &self.remembered[at] {
            return pass(values, to);
        }
        if std::mem::replace(&mut self.open[at], true) {
            return pass(&self.zeros(), to);
        }
        let sum = self.sum(at);
        let activated: Vec<f64> = sum.iter().map(|&u| activate(activation, u)).collect();
        pass(&activated, to);
        // The authors' code remembers the sum: later consumers see the node without its activation. The map of
        // an output is made after that: unless it becomes 0, the activated value is kept for it.
        let is_hidden = matches!(self.genotype.nodes[at].1, NodeKind::Hidden(_));
        let is_raw = self.rules.follow_code(Matter::Targets) && (is_hidden || self.rules.follow_code(Matter::Outputs));
        self.remembered[at] = Some(if is_raw { sum } else { activated });
    }

    fn sum(&mut self, at: usize) -> Vec<f64> {
        let mut sum = self.zeros();
        for (source, weight) in std::mem::take(&mut self.sources[at]) {
            self.give(source, |value, sum| *sum += weight * value, &mut sum);
        }
        sum
    }

    fn zeros(&self) -> Vec<f64> {
        vec![0.0; self.inputs[0].len()]
    }
}

fn inputs(rules: Rules, width: usize, height: usize) -> Vec<Vec<f64>> {
    let along = |index: usize, length: usize| match length {
        // A coordinate without extent is the middle; in the authors' code it is the low end.
        0 | 1 if rules.follow_code(Matter::Depth) => -1.0,
        0 | 1 => 0.0,
        // Integers first, so that opposite places have exactly opposite coordinates.
        _ => (2.0 * index as f64 - (length - 1) as f64) / (length - 1) as f64,
    };
    let places = || (0..height).flat_map(|row| (0..width).map(move |column| (row, column)));
    let x = if rules.follow_code(Matter::Depth) { -1.0 } else { 0.0 };
    let rows: Vec<f64> = places().map(|(row, _)| along(row, height)).collect();
    let columns: Vec<f64> = places().map(|(_, column)| along(column, width)).collect();
    let distance = rows.iter().zip(&columns).map(|(y, z)| (x * x + y * y + z * z).sqrt()).collect();
    let places = width * height;
    vec![vec![x; places], rows, columns, scaled(distance, rules), vec![1.0; places]]
}

fn scaled(values: Vec<f64>, rules: Rules) -> Vec<f64> {
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let flat = if rules.follow_code(Matter::Depth) { -1.0 } else { 0.0 };
    values.iter().map(|v| if most > least { (v - least) / (most - least) * 2.0 - 1.0 } else { flat }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shared_hidden() -> Genotype {
        let node = |id, kind| (NodeId(id), kind);
        let link = |source, target, weight| Link { source: NodeId(source), target: NodeId(target), weight };
        Genotype {
            nodes: vec![
                node(0, NodeKind::Input(4)),
                node(1, NodeKind::Output(0, Activation::Abs)),
                node(2, NodeKind::Output(1, Activation::Abs)),
                node(100, NodeKind::Hidden(Activation::Square)),
            ],
            links: vec![link(0, 100, 3.0), link(100, 1, 1.0), link(100, 2, 1.0)],
        }
    }

    fn values(genotype: &Genotype, rules: Rules) -> Vec<f64> {
        scores(genotype, rules, 1, 1).iter().map(|map| map.scores[0]).collect()
    }

    #[test]
    fn only_the_code_gives_the_raw_sum_to_a_second_target() {
        assert_eq!(values(&shared_hidden(), Rules::PAPER), [9.0, 9.0]);
        assert_eq!(values(&shared_hidden(), Rules::CODE), [9.0, 3.0]);
        assert_eq!(values(&shared_hidden(), Matter::Targets.into()), [9.0, 3.0]);
    }

    #[test]
    fn only_the_code_sets_an_output_read_by_an_earlier_one_to_zero() {
        let mut genotype = shared_hidden();
        genotype.links = vec![
            Link { source: NodeId(0), target: NodeId(2), weight: -2.0 },
            Link { source: NodeId(2), target: NodeId(1), weight: 5.0 },
        ];
        assert_eq!(values(&genotype, Rules::PAPER), [10.0, 2.0]);
        assert_eq!(values(&genotype, Rules::CODE), [10.0, 0.0]);
        assert_eq!(values(&genotype, Matter::Outputs.into()), [10.0, 0.0]);
        assert_eq!(values(&genotype, Matter::Targets.into()), [10.0, 2.0]);
    }

    #[test]
    fn a_cycle_ends() {
        let mut genotype = shared_hidden();
        genotype.links.push(Link { source: NodeId(1), target: NodeId(100), weight: 1.0 });
        assert!(values(&genotype, Rules::PAPER).iter().all(|v| v.is_finite()));
    }

    #[test]
    fn coordinates_are_opposite_at_opposite_places() {
        let maps = inputs(Rules::PAPER, 7, 5);
        for row in 0..5 {
            for column in 0..7 {
                let (here, there) = (row * 7 + column, row * 7 + 6 - column);
                assert_eq!(maps[2][here].to_bits(), (0.0 - maps[2][there]).to_bits());
                assert_eq!(maps[3][here].to_bits(), maps[3][there].to_bits());
            }
        }
        assert_eq!((maps[1][0], maps[2][0], maps[3][0]), (-1.0, -1.0, 1.0));
        assert_eq!(maps[3][2 * 7 + 3], -1.0);
    }

    #[test]
    fn x_is_constant_in_the_code_and_absent_in_the_paper() {
        assert_eq!(start(8, Rules::CODE).links.len(), 45);
        assert_eq!(start(8, Rules::PAPER).links.len(), 36);
        assert!(inputs(Rules::CODE, 5, 5)[0].iter().all(|&x| x == -1.0));
    }
}
