//! The phases of a wave machine: when each gate reads its nets, so that as few buffers as possible delay them.
//!
//! A gate at phase p shows its output to a gate at phase p + 1, or through buffers to a later one. A net that crosses
//! a register gains the length of a step. So each net bounds the difference of two phases, and the buffers of a driver
//! are those that its latest listener needs. Their sum is an L-natural convex function of the phases (Murota,
//! *Discrete Convex Analysis*, 2003, chapter 10): where no set of gates is better moved together by one, it is at its
//! minimum, and the best set to move is a minimum cut, as in retiming for few registers (Hurst, Mishchenko and
//! Brayton, FMCAD 2007). The shortest step is that of the slowest loop (Leiserson and Saxe, *Algorithmica* 6, 1991).

use petgraph::algo::dinics;
use petgraph::graph::{DiGraph, NodeIndex};
use petgraph::visit::EdgeRef;

use crate::waves::graph::{Driver, Tap, WaveGraph};

/// Rounds of relaxation between two looks for a loop that is too slow.
const ROUNDS: usize = 8;

/// The most moves of phases, times the nets that they look at.
const MOST_WORK: usize = 3_000_000;

const UNCUT: u32 = u32::MAX / 4;

/// When each gate reads its nets, in beats after the beginning of a step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Phases {
    /// Beats of a step.
    pub period: u32,
    /// For each port, the beat before the one in which it is applied.
    pub inputs: Vec<i64>,
    pub gates: Vec<i64>,
    /// For each output, the beat after the one at whose end it is read.
    pub outputs: Vec<i64>,
    /// Whether no phases need fewer buffers; the search for them ends early in very large graphs.
    pub is_optimal: bool,
}

/// A driver with its listeners, each with the steps by which it is later.
struct Net {
    driver: usize,
    listeners: Vec<(usize, i64)>,
}

/// `p[to] >= p[from] + beats + steps * period`.
struct Bound {
    from: usize,
    to: usize,
    beats: i64,
    steps: i64,
}

pub struct Balancing<'g> {
    graph: &'g WaveGraph,
    nets: Vec<Net>,
    bounds: Vec<Bound>,
    phases: usize,
}

impl<'g> Balancing<'g> {
    pub fn new(graph: &'g WaveGraph) -> Self {
        let drivers = graph.inputs + graph.gates.len();
        let [first_input, first_output] = [drivers + graph.outputs.len(), drivers + graph.outputs.len() + 1];
        let mut balancing = Self { graph, nets: Vec::new(), bounds: Vec::new(), phases: first_output + 1 };
        balancing.nets = (0..drivers).map(|driver| Net { driver, listeners: Vec::new() }).collect();
        for (at, gate) in graph.gates.iter().enumerate() {
            gate.pins.iter().for_each(|tap| balancing.listen(tap, graph.inputs + at));
        }
        for (at, tap) in graph.outputs.iter().enumerate() {
            balancing.listen(tap, drivers + at);
        }
        balancing.nets.retain(|net| !net.listeners.is_empty());
        let bounds = balancing.nets.iter().flat_map(|net| {
            let bound = |&(to, later): &(usize, i64)| Bound { from: net.driver, to, beats: 1, steps: -later };
            net.listeners.iter().map(bound)
        });
        balancing.bounds = bounds.collect();
        // All inputs of a step are applied within its length, and all outputs are read within it.
        let ports = (0..graph.inputs).filter(|&port| balancing.nets.iter().any(|net| net.driver == port));
        let read = (drivers..drivers + graph.outputs.len()).map(|output| (first_output, output));
        for (first, one) in ports.map(|port| (first_input, port)).chain(read).collect::<Vec<_>>() {
            balancing.bounds.push(Bound { from: first, to: one, beats: 0, steps: 0 });
            balancing.bounds.push(Bound { from: one, to: first, beats: 1, steps: -1 });
        }
        balancing
    }

    fn listen(&mut self, tap: &Tap, listener: usize) {
        let driver = match tap.driver {
            Driver::Constant(_) => return,
            Driver::Input(port) => port,
            Driver::Gate(gate) => self.graph.inputs + gate,
        };
        self.nets[driver].listeners.push((listener, tap.later));
    }

    pub fn is_enough(&self, period: u32) -> bool {
        self.earliest(period).is_some()
    }

    pub fn least_period(&self) -> u32 {
        let (mut short, mut enough) = (0, self.graph.gates.len() as u32 + 1);
        // The longest chain of gates is often far shorter than that.
        let mut tried = 1;
        while tried < enough && self.earliest(tried).is_none() {
            short = tried;
            tried *= 2;
        }
        enough = enough.min(tried);
        while enough - short > 1 {
            let middle = short + (enough - short) / 2;
            if self.earliest(middle).is_some() { enough = middle } else { short = middle }
        }
        enough
    }

    /// Phases with as few buffers as the search finds, and that number; `None` if `period` beats are too short.
    pub fn fewest_buffers(&self, period: u32) -> Option<(Phases, usize)> {
        let mut phase = self.earliest(period)?;
        let most = (MOST_WORK / self.bounds.len().max(1)).max(10);
        let mut is_optimal = false;
        for _ in 0..most {
            let Some(moved) = self.best_move(&phase, period) else {
                is_optimal = true;
                break;
            };
            let by = self.longest_move(&phase, &moved, period);
            phase.iter_mut().zip(&moved).filter(|(_, moved)| **moved).for_each(|(phase, _)| *phase += by);
        }
        let buffers = self.nets.iter().map(|net| self.longest_chain(net, &phase, period)).sum::<i64>();
        let inputs = self.graph.inputs;
        let drivers = inputs + self.graph.gates.len();
        let phases = Phases {
            period,
            inputs: phase[..inputs].to_vec(),
            gates: phase[inputs..drivers].to_vec(),
            outputs: phase[drivers..drivers + self.graph.outputs.len()].to_vec(),
            is_optimal,
        };
        Some((phases, usize::try_from(buffers).expect("no net has fewer than no buffers")))
    }

    /// The earliest phases from 0 on; `None` if a loop is slower than the period.
    fn earliest(&self, period: u32) -> Option<Vec<i64>> {
        let mut phase = vec![0; self.phases];
        let mut cause: Vec<Option<usize>> = vec![None; self.phases];
        for round in 1.. {
            let mut changed = false;
            for bound in &self.bounds {
                let least = phase[bound.from] + bound.beats + bound.steps * i64::from(period);
                if phase[bound.to] < least {
                    (phase[bound.to], cause[bound.to], changed) = (least, Some(bound.from), true);
                }
            }
            if !changed {
                return Some(phase);
            }
            if round % ROUNDS == 0 && has_loop(&cause) {
                return None;
            }
        }
        unreachable!("the rounds have no end")
    }

    fn chain(net: &Net, (listener, later): (usize, i64), phase: &[i64], period: u32) -> i64 {
        phase[listener] + later * i64::from(period) - phase[net.driver] - 1
    }

    fn longest_chain(&self, net: &Net, phase: &[i64], period: u32) -> i64 {
        net.listeners.iter().map(|&listener| Self::chain(net, listener, phase, period)).max().unwrap_or(0)
    }

    /// The phases that are better one beat later, all together; `None` if none are.
    fn best_move(&self, phase: &[i64], period: u32) -> Option<Vec<bool>> {
        let mut cuts = DiGraph::<(), u32>::with_capacity(self.phases + self.nets.len() + 2, 4 * self.bounds.len());
        let nodes: Vec<NodeIndex> = (0..self.phases).map(|_| cuts.add_node(())).collect();
        let [source, sink] = [cuts.add_node(()), cuts.add_node(())];
        let mut gain = vec![0i64; self.phases];
        for net in &self.nets {
            gain[net.driver] += 1;
            let longest = self.longest_chain(net, phase, period);
            let is_latest = |&&listener: &&(usize, i64)| Self::chain(net, listener, phase, period) == longest;
            let latest: Vec<usize> = net.listeners.iter().filter(is_latest).map(|&(listener, _)| listener).collect();
            if let [only] = latest[..] {
                gain[only] -= 1;
                continue;
            }
            let chain = cuts.add_node(());
            cuts.add_edge(chain, sink, 1);
            cuts.extend_with_edges(latest.iter().map(|&listener| (nodes[listener], chain, UNCUT)));
        }
        for bound in &self.bounds {
            if phase[bound.to] == phase[bound.from] + bound.beats + bound.steps * i64::from(period) {
                cuts.add_edge(nodes[bound.from], nodes[bound.to], UNCUT);
            }
        }
        for (&node, &gain) in nodes.iter().zip(&gain) {
            let amount = u32::try_from(gain.unsigned_abs()).expect("a gate has few nets");
            if gain != 0 {
                let [from, to] = if gain > 0 { [source, node] } else { [node, sink] };
                cuts.add_edge(from, to, amount);
            }
        }
        let wanted: i64 = gain.iter().filter(|&&gain| gain > 0).sum();
        let (flow, flows) = dinics(&cuts, source, sink);
        (i64::from(flow) < wanted).then(|| {
            let reached = reached(&cuts, &flows, source);
            nodes.iter().map(|node| reached[node.index()]).collect()
        })
    }

    fn longest_move(&self, phase: &[i64], moved: &[bool], period: u32) -> i64 {
        let room = |bound: &Bound| {
            let least = phase[bound.from] + bound.beats + bound.steps * i64::from(period);
            (moved[bound.from] && !moved[bound.to]).then(|| phase[bound.to] - least)
        };
        let overtaken = |net: &Net| {
            let longest = self.longest_chain(net, phase, period);
            let chains = |is_moved: bool| {
                let of = net.listeners.iter().filter(move |(listener, _)| moved[*listener] == is_moved);
                of.map(|&listener| Self::chain(net, listener, phase, period)).max()
            };
            // Until a listener that moves becomes the latest.
            chains(true).map(|chain| longest - chain).filter(|&room| room > 0)
        };
        self.bounds.iter().filter_map(room).chain(self.nets.iter().filter_map(overtaken)).min().unwrap_or(1).max(1)
    }
}

fn has_loop(cause: &[Option<usize>]) -> bool {
    let mut seen: Vec<Option<usize>> = vec![None; cause.len()];
    (0..cause.len()).any(|first| {
        let mut at = first;
        while seen[at].is_none() {
            seen[at] = Some(first);
            match cause[at] {
                Some(before) => at = before,
                None => return false,
            }
        }
        seen[at] == Some(first)
    })
}

fn reached(cuts: &DiGraph<(), u32>, flows: &[u32], source: NodeIndex) -> Vec<bool> {
    let mut reached = vec![false; cuts.node_count()];
    reached[source.index()] = true;
    let mut waiting = vec![source];
    while let Some(node) = waiting.pop() {
        let on = cuts.edges(node).filter(|edge| *edge.weight() > flows[edge.id().index()]).map(|edge| edge.target());
        let back = cuts.edges_directed(node, petgraph::Direction::Incoming);
        let back = back.filter(|edge| flows[edge.id().index()] > 0).map(|edge| edge.source());
        for next in on.chain(back).collect::<Vec<_>>() {
            if !std::mem::replace(&mut reached[next.index()], true) {
                waiting.push(next);
            }
        }
    }
    reached
}
