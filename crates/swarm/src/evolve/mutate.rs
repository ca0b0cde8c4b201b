//! The six mutation operators on networks (docs/physics.md 11).

use rand::{Rng, RngExt};

use nbc_base::model::{Activation, Genotype, Link, Matter, MutationWeights, NodeId, NodeKind, Rules};

const LINK_DRAWS: usize = 999;
const WEIGHT_STEP: f64 = 0.5;

/// Activations that hidden nodes draw from: the paper's text names four, the authors' code has the negatives too.
fn activations(rules: Rules) -> &'static [Activation] {
    use Activation::{Abs, NegAbs, NegSqrtAbs, NegSquare, Sine, SqrtAbs, Square};
    if rules.follow_code(Matter::Activations) {
        &[Sine, Abs, NegAbs, Square, NegSquare, SqrtAbs, NegSqrtAbs]
    } else {
        &[Sine, Abs, Square, SqrtAbs]
    }
}

/// Applies one operator, drawn by weight, and removes unconnected nodes.
pub fn mutate<R: Rng>(genotype: &mut Genotype, weights: &MutationWeights, rules: Rules, rng: &mut R) {
    type Operator<R> = fn(&mut Genotype, Rules, &mut R);
    let operators: [(f64, Operator<R>); 6] = [
        (weights.add_node, add_node),
        (weights.remove_node, remove_node),
        (weights.add_link, add_link),
        (weights.remove_link, remove_link),
        (weights.change_activation, change_activation),
        (weights.change_weight, change_weight),
    ];
    let total: f64 = operators.iter().map(|(weight, _)| weight.max(0.0)).sum();
    let mut left = rng.random::<f64>() * total;
    for (weight, operator) in operators {
        left -= weight.max(0.0);
        if left < 0.0 {
            operator(genotype, rules, rng);
            break;
        }
    }
    prune(genotype);
}

pub(crate) fn pick<R: Rng>(count: usize, rng: &mut R) -> Option<usize> {
    (count > 0).then(|| rng.random_range(0..count as u64) as usize)
}

fn add_node<R: Rng>(genotype: &mut Genotype, rules: Rules, rng: &mut R) {
    let Some(at) = pick(genotype.links.len(), rng) else { return };
    let activation = draw_activation(activations(rules), rng);
    let Link { source, target, weight } = genotype.links.remove(at);
    let node = NodeId(genotype.nodes.last().map_or(0, |(id, _)| id.0 + 1));
    genotype.nodes.push((node, NodeKind::Hidden(activation)));
    genotype.links.push(Link { source, target: node, weight });
    genotype.links.push(Link { source: node, target, weight: 1.0 });
}

fn remove_node<R: Rng>(genotype: &mut Genotype, _: Rules, rng: &mut R) {
    let hidden: Vec<NodeId> = hidden_nodes(genotype).collect();
    let Some(at) = pick(hidden.len(), rng) else { return };
    let node = hidden[at];
    let into: Vec<Link> = genotype.links.iter().filter(|link| link.target == node).copied().collect();
    let out: Vec<Link> = genotype.links.iter().filter(|link| link.source == node).copied().collect();
    remove(genotype, node);
    for a in &into {
        for b in &out {
            set_link(genotype, Link { source: a.source, target: b.target, weight: a.weight * b.weight });
        }
    }
}

fn add_link<R: Rng>(genotype: &mut Genotype, rules: Rules, rng: &mut R) {
    for _ in 0..LINK_DRAWS {
        let Some(link) = draw_link(genotype, rng) else { return };
        if is_admissible(genotype, link) {
            set_link(genotype, link);
            return;
        }
    }
    if rules.follow_code(Matter::Links) {
        // The authors' code uses the last pair that it drew, admissible or not, unless it closes a cycle.
        if let Some(link) = draw_link(genotype, rng).filter(|link| !closes_cycle(genotype, *link)) {
            set_link(genotype, link);
        }
    }
}

fn remove_link<R: Rng>(genotype: &mut Genotype, _: Rules, rng: &mut R) {
    if let Some(at) = pick(genotype.links.len(), rng) {
        genotype.links.remove(at);
    }
}

/// By the paper's text outputs keep their sigmoid; in the authors' code they may lose it for ever.
fn change_activation<R: Rng>(genotype: &mut Genotype, rules: Rules, rng: &mut R) {
    let mut changeable: Vec<&mut Activation> = genotype
        .nodes
        .iter_mut()
        .filter_map(|(_, kind)| match kind {
            NodeKind::Hidden(activation) => Some(activation),
            NodeKind::Output(_, activation) => rules.follow_code(Matter::Sigmoid).then_some(activation),
            NodeKind::Input(_) => None,
        })
        .collect();
    if let Some(at) = pick(changeable.len(), rng) {
        let others: Vec<Activation> =
            activations(rules).iter().copied().filter(|&other| other != *changeable[at]).collect();
        *changeable[at] = draw_activation(&others, rng);
    }
}

fn change_weight<R: Rng>(genotype: &mut Genotype, _: Rules, rng: &mut R) {
    let Some(at) = pick(genotype.links.len(), rng) else { return };
    let weight = &mut genotype.links[at].weight;
    let before = *weight;
    while *weight == before {
        *weight = (before + WEIGHT_STEP * normal(rng)).clamp(-1.0, 1.0);
    }
}

fn draw_activation<R: Rng>(among: &[Activation], rng: &mut R) -> Activation {
    among[rng.random_range(0..among.len() as u64) as usize]
}

/// A draw from the standard normal distribution (Box and Muller).
fn normal<R: Rng>(rng: &mut R) -> f64 {
    let radius = (-2.0 * libm::log(1.0 - rng.random::<f64>())).sqrt();
    radius * libm::cos(2.0 * std::f64::consts::PI * rng.random::<f64>())
}

fn draw_link<R: Rng>(genotype: &Genotype, rng: &mut R) -> Option<Link> {
    let source = genotype.nodes[pick(genotype.nodes.len(), rng)?].0;
    let target = genotype.nodes[pick(genotype.nodes.len(), rng)?].0;
    let weight = if rng.random::<bool>() { 0.1 } else { -0.1 };
    Some(Link { source, target, weight })
}

fn is_admissible(genotype: &Genotype, link: Link) -> bool {
    let kind = |node| genotype.nodes.iter().find(|(id, _)| *id == node).map(|(_, kind)| *kind);
    let linked = |a, b| genotype.links.iter().any(|link| link.source == a && link.target == b);
    link.source != link.target
        && !matches!(kind(link.source), Some(NodeKind::Output(..)))
        && !matches!(kind(link.target), Some(NodeKind::Input(_)))
        && !linked(link.source, link.target)
        && !linked(link.target, link.source)
        && !closes_cycle(genotype, link)
}

fn closes_cycle(genotype: &Genotype, link: Link) -> bool {
    let mut open = vec![link.target];
    let mut seen = vec![link.target];
    while let Some(node) = open.pop() {
        if node == link.source {
            return true;
        }
        for next in genotype.links.iter().filter(|link| link.source == node).map(|link| link.target) {
            if !seen.contains(&next) {
                seen.push(next);
                open.push(next);
            }
        }
    }
    false
}

fn set_link(genotype: &mut Genotype, link: Link) {
    let same = |other: &&mut Link| other.source == link.source && other.target == link.target;
    match genotype.links.iter_mut().find(same) {
        Some(there) => there.weight = link.weight,
        None => genotype.links.push(link),
    }
}

fn hidden_nodes(genotype: &Genotype) -> impl Iterator<Item = NodeId> + '_ {
    genotype.nodes.iter().filter(|(_, kind)| matches!(kind, NodeKind::Hidden(_))).map(|(id, _)| *id)
}

fn remove(genotype: &mut Genotype, node: NodeId) {
    genotype.nodes.retain(|(id, _)| *id != node);
    genotype.links.retain(|link| link.source != node && link.target != node);
}

fn prune(genotype: &mut Genotype) {
    while let Some(node) = loose_node(genotype) {
        remove(genotype, node);
    }
}

fn loose_node(genotype: &Genotype) -> Option<NodeId> {
    let has_out = |node| genotype.links.iter().any(|link| link.source == node);
    let has_in = |node| genotype.links.iter().any(|link| link.target == node);
    hidden_nodes(genotype).find(|&node| !has_out(node) || !has_in(node))
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use crate::evolve::cppn;

    fn mutated(rules: Rules, seed: u64, times: usize) -> Genotype {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut genotype = cppn::start(8, rules);
        for _ in 0..times {
            mutate(&mut genotype, &MutationWeights::default(), rules, &mut rng);
        }
        genotype
    }

    #[test]
    fn networks_stay_well_formed() {
        for rules in [Rules::PAPER, Rules::CODE] {
            for seed in 0..20 {
                let genotype = mutated(rules, seed, 200);
                let outputs = genotype.nodes.iter().filter(|(_, kind)| matches!(kind, NodeKind::Output(..))).count();
                assert_eq!(outputs, 9);
                assert!(genotype.nodes.is_sorted_by_key(|(id, _)| *id));
                for (i, link) in genotype.links.iter().enumerate() {
                    assert!(genotype.nodes.iter().any(|(id, _)| *id == link.source), "a link starts at a node");
                    assert!(genotype.nodes.iter().any(|(id, _)| *id == link.target), "a link ends at a node");
                    let twin = |other: &Link| (other.source, other.target) == (link.source, link.target);
                    assert!(!genotype.links[..i].iter().any(twin), "no pair is linked twice");
                    let mut without = genotype.clone();
                    without.links.remove(i);
                    assert!(!closes_cycle(&without, *link), "no link closes a cycle");
                }
            }
        }
    }

    #[test]
    fn outputs_keep_their_sigmoid_by_the_text_and_lose_it_by_the_code() {
        let lost = |rules| {
            let genotype = mutated(rules, 3, 200);
            genotype
                .nodes
                .iter()
                .filter(
                    |(_, kind)| matches!(kind, NodeKind::Output(_, activation) if *activation != Activation::Sigmoid),
                )
                .count()
        };
        assert_eq!(lost(Rules::PAPER), 0);
        assert!(lost(Rules::CODE) > 0);
    }

    #[test]
    fn hidden_nodes_take_four_activations_by_the_text_and_seven_by_the_code() {
        let drawn = |rules| {
            let genotypes = (0..20).map(|seed| mutated(rules, seed, 200));
            let mut found = std::collections::BTreeSet::new();
            for (_, kind) in genotypes.flat_map(|genotype| genotype.nodes) {
                if let NodeKind::Hidden(activation) = kind {
                    found.insert(format!("{activation:?}"));
                }
            }
            found.len()
        };
        assert_eq!((drawn(Rules::PAPER), drawn(Rules::CODE)), (4, 7));
    }

    #[test]
    fn adding_a_link_to_a_full_network_does_nothing_by_the_text_and_overwrites_by_the_code() {
        let changed = |rules| {
            let start = cppn::start(8, rules);
            (0..20).any(|seed| {
                let mut genotype = start.clone();
                add_link(&mut genotype, rules, &mut ChaCha8Rng::seed_from_u64(seed));
                genotype != start
            })
        };
        assert!(!changed(Rules::PAPER));
        assert!(changed(Rules::CODE));
    }

    #[test]
    fn removing_a_node_bridges_it_with_the_product_of_weights() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let mut genotype = cppn::start(8, Rules::PAPER);
        genotype.links[0].weight = 0.5;
        let before = genotype.links[0];
        for _ in 0..200 {
            add_node(&mut genotype, Rules::PAPER, &mut rng);
        }
        for _ in 0..200 {
            remove_node(&mut genotype, Rules::PAPER, &mut rng);
        }
        assert_eq!(hidden_nodes(&genotype).count(), 0);
        assert_eq!(genotype.links.len(), 36);
        assert!(genotype.links.contains(&before));
    }

    #[test]
    fn a_normal_draw_has_mean_0_and_deviation_1() {
        let mut rng = ChaCha8Rng::seed_from_u64(5);
        let draws: Vec<f64> = (0..20_000).map(|_| normal(&mut rng)).collect();
        let mean = draws.iter().sum::<f64>() / draws.len() as f64;
        let variance = draws.iter().map(|d| (d - mean) * (d - mean)).sum::<f64>() / draws.len() as f64;
        assert!(mean.abs() < 0.03 && (variance - 1.0).abs() < 0.05, "mean {mean}, variance {variance}");
    }
}
