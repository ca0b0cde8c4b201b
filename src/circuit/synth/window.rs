//! Windows: small parts of a wide network with few inputs, which are optimized separately and put back.

use std::collections::{BTreeMap, BTreeSet};

use rand_chacha::ChaCha8Rng;

use crate::circuit::network::{Network, Signal};
use crate::circuit::synth::graph::Graph;
use crate::circuit::synth::prices::Prices;
use crate::circuit::synth::walk::{WalkPlan, improve_all};

/// The size and the number of windows, and the search in each.
#[derive(Clone, Copy, Debug)]
pub struct WindowPlan {
    /// Windows to cut.
    pub windows: usize,
    /// The most inputs of a window.
    pub inputs: usize,
    /// The most gates of a window.
    pub gates: usize,
    /// The search in each.
    pub plan: WalkPlan,
}

/// Optimizes a network window by window.
pub fn improve(
    network: &Network,
    prices: &Prices,
    stages: &[u32],
    plan: WindowPlan,
    random: &mut ChaCha8Rng,
) -> Network {
    let mut graph = Graph::new(network, prices, stages, &[]);
    for i in 0..plan.windows {
        if graph.order().is_empty() {
            break;
        }
        // Every gate is the seed of a window once before any is twice.
        let at =
            if i < graph.order().len() { i * 7919 % graph.order().len() } else { below(random, graph.order().len()) };
        let seed = graph.order()[at];
        if let Some(window) = Window::around(&graph, seed, plan, random) {
            window.replace(&mut graph, plan.plan, random);
        }
    }
    graph.network()
}

fn below(random: &mut ChaCha8Rng, bound: usize) -> usize {
    ((u64::from(rand::Rng::next_u32(random)) * bound as u64) >> 32) as usize
}

/// A part of a graph; no path leaves it and returns to it.
struct Window {
    gates: BTreeSet<Signal>,
    leaves: Vec<Signal>,
}

impl Window {
    /// Grows a window from a gate, towards drivers and listeners.
    fn around(graph: &Graph<'_>, seed: Signal, plan: WindowPlan, random: &mut ChaCha8Rng) -> Option<Self> {
        let mut gates = BTreeSet::from([seed]);
        let mut leaves: BTreeSet<Signal> = sources(graph.node(seed).pins).collect();
        let gate_limit = plan.gates / 2 + below(random, plan.gates / 2 + 1);
        let input_limit = plan.inputs.min(4 + below(random, plan.inputs.saturating_sub(3).max(1)));
        while gates.len() < gate_limit {
            let Some(next) = next(graph, &gates, &leaves, input_limit, random) else {
                break;
            };
            leaves.remove(&next);
            gates.insert(next);
            leaves.extend(sources(graph.node(next).pins).filter(|pin| !gates.contains(pin)));
        }
        close(graph, &mut gates, &mut leaves, plan.inputs)?;
        (gates.len() > 1).then(|| Self { gates, leaves: leaves.into_iter().collect() })
    }

    /// Searches for a cheaper form of the window and puts it in the window's place.
    fn replace(&self, graph: &mut Graph<'_>, plan: WalkPlan, random: &mut ChaCha8Rng) {
        let mut order: Vec<_> = self.gates.iter().copied().collect();
        order.sort_unstable_by_key(|&gate| graph.position(gate));
        let mut network = Network::new(self.leaves.len());
        let mut signal: BTreeMap<Signal, Signal> = BTreeMap::from([(0, 0), (1, 1)]);
        signal.extend(self.leaves.iter().enumerate().map(|(i, &leaf)| (leaf, network.input(i))));
        for &gate in &order {
            let node = graph.node(gate);
            let made = network.add(node.function, node.pins.map(|pin| signal[&pin]));
            signal.insert(gate, made);
        }
        let shown = |&&gate: &&Signal| {
            graph.fanout(gate).iter().any(|listener| !self.gates.contains(listener)) || graph.is_output(gate)
        };
        let roots: Vec<_> = order.iter().filter(shown).copied().collect();
        network.outputs = roots.iter().map(|root| signal[root]).collect();
        let stages: Vec<_> = self.leaves.iter().map(|&leaf| graph.node(leaf).stage).collect();
        let before = network.clone();
        let better = improve_all(&network, graph.prices(), &stages, plan, random);
        if better != before {
            self.put(graph, &better, &roots);
        }
    }

    fn put(&self, graph: &mut Graph<'_>, network: &Network, roots: &[Signal]) {
        let mut made: Vec<Signal> = vec![0, 1];
        made.extend(&self.leaves);
        for gate in &network.gates {
            // Adds new gates even if there are equal ones, because those may be about to be removed.
            let signal = graph.make_new(gate.function, gate.pins.map(|pin| made[pin as usize]));
            made.push(signal);
        }
        let news: Vec<_> = network.outputs.iter().map(|&output| made[output as usize]).collect();
        news.iter().for_each(|&new| graph.hold(new));
        for (&old, &new) in roots.iter().zip(&news) {
            graph.substitute(old, new);
        }
        news.iter().for_each(|&new| graph.let_go(new));
        made.iter().rev().for_each(|&signal| graph.release(signal));
        graph.sort();
        graph.refresh();
    }
}

/// The pins of a gate that are not constants.
fn sources(pins: [Signal; 2]) -> impl Iterator<Item = Signal> {
    pins.into_iter().filter(|&pin| pin > 1)
}

/// The next gate to add: one that adds the fewest inputs; of several, a random one.
fn next(
    graph: &Graph<'_>,
    gates: &BTreeSet<Signal>,
    leaves: &BTreeSet<Signal>,
    limit: usize,
    random: &mut ChaCha8Rng,
) -> Option<Signal> {
    let mut best: Vec<Signal> = Vec::new();
    let mut least = usize::MAX;
    let mut consider = |gate: Signal, is_leaf: bool| {
        let new = |pin: &Signal| !gates.contains(pin) && !leaves.contains(pin);
        let pins = graph.node(gate).pins;
        let added = sources(pins).filter(new).count() - usize::from(pins[0] == pins[1] && pins[0] > 1 && new(&pins[0]));
        if leaves.len() + added > limit + usize::from(is_leaf) {
            return;
        }
        let rank = added + 1 - usize::from(is_leaf);
        if rank < least {
            least = rank;
            best.clear();
        }
        if rank == least && !best.contains(&gate) {
            best.push(gate);
        }
    };
    for &leaf in leaves.iter().filter(|&&leaf| graph.node(leaf).alive) {
        consider(leaf, true);
    }
    for &gate in gates.iter().chain(leaves) {
        if graph.fanout(gate).len() <= 12 {
            for &listener in graph.fanout(gate) {
                if !gates.contains(&listener) && !leaves.contains(&listener) {
                    consider(listener, false);
                }
            }
        }
    }
    (!best.is_empty()).then(|| best[below(random, best.len())])
}

/// Adds leaves that depend on the window, until there are none; `None` if that takes too many inputs.
fn close(graph: &Graph<'_>, gates: &mut BTreeSet<Signal>, leaves: &mut BTreeSet<Signal>, limit: usize) -> Option<()> {
    loop {
        let position = |signal: &Signal| graph.position(*signal);
        let first = gates.iter().map(position).min()?;
        let last = leaves.iter().filter(|&&leaf| graph.node(leaf).alive).map(position).max().unwrap_or(0);
        let mut inside: BTreeSet<Signal> = BTreeSet::new();
        if first <= last {
            for &signal in &graph.order()[first..=last] {
                let pins = graph.node(signal).pins;
                if gates.contains(&signal) || pins.iter().any(|pin| inside.contains(pin)) {
                    inside.insert(signal);
                }
            }
        }
        let Some(&leaf) = leaves.iter().find(|leaf| inside.contains(leaf)) else {
            return (leaves.len() <= limit).then_some(());
        };
        leaves.remove(&leaf);
        gates.insert(leaf);
        leaves.extend(sources(graph.node(leaf).pins).filter(|pin| !gates.contains(pin)));
        if leaves.len() > limit {
            return None;
        }
    }
}
