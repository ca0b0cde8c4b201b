//! The search: a random walk over networks that compute the same outputs. Each step replaces one gate by another
//! function of other signals that agrees wherever the gate matters (resubstitution under observability don't-cares). It
//! never makes the network more expensive, except for rare steps up at a small temperature. Steps of equal cost are
//! accepted, because they lead out of local optima.

use rand_chacha::ChaCha8Rng;

use crate::CancelFlag;
use crate::network::{Network, Signal, words};
use crate::synth::candidates::{Finder, Replacement, Rows, TRIES, below};
use crate::synth::graph::{Graph, every_pattern};
use crate::synth::prices::Prices;
use crate::synth::surroundings::Surroundings;
use nbc_base::model::Function;

#[derive(Clone, Copy, Debug)]
pub struct WalkPlan<'a> {
    pub visits: u64,
    /// One of this number of visits may make the network slightly more expensive; 0 for never.
    pub climb: u32,
    /// Visits without a new best after which the search returns to the best so far.
    pub patience: u64,
    pub delay: DelayGoal,
    pub cancel: Option<&'a CancelFlag>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DelayGoal {
    #[default]
    Any,
    /// No output may become later.
    Keep,
    /// Gates on the slowest paths are made earlier at any cost.
    SlowestPath,
    /// Gates are made earlier where that costs nothing.
    Shorten,
}

impl WalkPlan<'_> {
    pub fn downhill(visits: u64) -> Self {
        Self { visits, climb: 0, patience: u64::MAX, delay: DelayGoal::Any, cancel: None }
    }

    pub fn is_cancelled(&self) -> bool {
        self.cancel.is_some_and(CancelFlag::is_raised)
    }
}

/// The patterns must be all that can occur; without patterns, each gate is seen in its surroundings only.
pub fn improve(
    network: &Network,
    prices: &Prices,
    stages: &[u32],
    patterns: &[Vec<u64>],
    plan: WalkPlan<'_>,
    random: &mut ChaCha8Rng,
) -> Network {
    let graph = Graph::new(network, prices, stages, patterns);
    let mut walk = Walk::new(graph, plan.delay, random);
    walk.surroundings = patterns.is_empty().then(Surroundings::default);
    if plan.delay == DelayGoal::SlowestPath {
        (0..plan.visits).take_while(|_| !plan.is_cancelled()).for_each(|_| walk.shorten_slowest_path());
        return walk.graph.network();
    }
    let mut best = walk.graph.network();
    let mut best_cost = walk.graph.cost;
    let mut best_at = 0;
    for visit in 0..plan.visits {
        if walk.graph.order.is_empty() || plan.is_cancelled() {
            break;
        }
        let slack = u32::from(plan.climb > 0 && walk.below(plan.climb as usize) == 0);
        if walk.visit(slack) && walk.graph.cost < best_cost {
            best = walk.graph.network();
            best_cost = walk.graph.cost;
            best_at = visit;
        } else if visit - best_at > plan.patience {
            walk.graph = Graph::new(&best, prices, stages, patterns);
            best_at = visit;
        }
    }
    if walk.graph.cost == best_cost { walk.graph.network() } else { best }
}

/// The network at the end of a walk, which may cost more: one of `plan.climb` visits may add a cell.
pub fn wander(
    network: &Network,
    prices: &Prices,
    patterns: &[Vec<u64>],
    plan: WalkPlan<'_>,
    random: &mut ChaCha8Rng,
) -> Network {
    let mut walk = Walk::new(Graph::new(network, prices, &[], patterns), plan.delay, random);
    for _ in 0..plan.visits {
        if walk.graph.order.is_empty() || plan.is_cancelled() {
            break;
        }
        let slack = u32::from(plan.climb > 0 && walk.below(plan.climb as usize) == 0);
        walk.visit(slack);
    }
    walk.graph.network()
}

pub fn improve_all(
    network: &Network,
    prices: &Prices,
    stages: &[u32],
    plan: WalkPlan<'_>,
    random: &mut ChaCha8Rng,
) -> Network {
    improve(network, prices, stages, &every_pattern(network.inputs), plan, random)
}

struct Walk<'p, 'r> {
    graph: Graph<'p>,
    delay: DelayGoal,
    selective: bool,
    exclusive: u32,
    deadline: u32,
    limit: Option<u32>,
    required: Vec<u32>,
    random: &'r mut ChaCha8Rng,
    /// Values with the visited gate inverted, for the signals marked as changed.
    flipped: Vec<u64>,
    row: Vec<u64>,
    changed: Vec<bool>,
    after: Vec<bool>,
    finder: Finder,
    surroundings: Option<Surroundings>,
}

/// Above this number of gates, a visit looks only for candidates that are likely to pay.
pub const MANY_GATES: usize = 150;
const MOST_DELAY_PRICE: u32 = 6;

impl<'p, 'r> Walk<'p, 'r> {
    fn new(graph: Graph<'p>, delay: DelayGoal, random: &'r mut ChaCha8Rng) -> Self {
        Self {
            selective: graph.order.len() > MANY_GATES,
            exclusive: graph.prices.cost(Function::XOR).unwrap_or(0),
            deadline: graph.depth(),
            graph,
            delay,
            limit: None,
            required: Vec::new(),
            random,
            flipped: Vec::new(),
            row: Vec::new(),
            changed: Vec::new(),
            after: Vec::new(),
            finder: Finder::new(),
            surroundings: None,
        }
    }

    fn below(&mut self, bound: usize) -> usize {
        below(self.random, bound)
    }

    fn visit(&mut self, slack: u32) -> bool {
        let at = self.below(self.graph.order.len());
        let gate = self.graph.order[at];
        match self.delay {
            DelayGoal::Keep => {
                self.require();
                self.limit = Some(self.required[gate as usize]);
            }
            DelayGoal::Shorten => self.limit = Some(self.graph.node(gate).arrival - 1),
            DelayGoal::Any | DelayGoal::SlowestPath => {}
        }
        self.change(gate, slack)
    }

    fn shorten_slowest_path(&mut self) {
        self.deadline = self.graph.depth();
        self.require();
        let (graph, required) = (&self.graph, &self.required);
        let late = |&&gate: &&Signal| graph.node(gate).arrival >= required[gate as usize];
        let critical: Vec<Signal> = graph.order.iter().filter(late).copied().collect();
        if !critical.is_empty() {
            let gate = critical[self.below(critical.len())];
            self.limit = Some(self.graph.node(gate).arrival - 1);
            self.change(gate, MOST_DELAY_PRICE);
        }
    }

    fn require(&mut self) {
        self.required.clear();
        self.required.resize(self.graph.nodes.len(), self.deadline);
        for &gate in self.graph.order.iter().rev() {
            let node = self.graph.node(gate);
            let before = self.required[gate as usize].saturating_sub(self.graph.prices.clock(node.function));
            for pin in node.pins {
                self.required[pin as usize] = self.required[pin as usize].min(before);
            }
        }
    }

    fn change(&mut self, gate: Signal, slack: u32) -> bool {
        let released = self.graph.released(gate) + slack;
        let deep = released >= if self.selective { 2 * self.graph.prices.unit() } else { 2 };
        self.finder.exclusive = !self.selective || released + 2 * self.graph.prices.unit() >= self.exclusive;
        match self.surroundings.take() {
            Some(mut surroundings) => {
                self.look_around(&mut surroundings, gate, deep);
                self.surroundings = Some(surroundings);
            }
            None => {
                self.observe(gate);
                self.find_divisors(gate);
                let rows = Rows { words: &self.graph.all_values, width: self.graph.width, places: None };
                self.finder.find(rows, deep, self.random);
            }
        }
        self.graph.leaving = Some(gate);
        let changed = self.choose(gate, i64::from(slack));
        self.graph.leaving = None;
        changed
    }

    fn look_around(&mut self, surroundings: &mut Surroundings, gate: Signal, deep: bool) {
        let graph = &self.graph;
        surroundings.look(graph, gate);
        surroundings.observe(graph, gate, &mut self.finder.on, &mut self.finder.off);
        let stage = graph.node(gate).stage;
        self.finder.divisors.clear();
        let known = surroundings.before().iter().copied();
        self.finder.divisors.extend(known.filter(|&signal| graph.node(signal).stage <= stage));
        self.finder.find(surroundings.rows(), deep, self.random);
    }

    /// `on`: the patterns in which the gate matters and is 1; `off`: those in which it matters and is 0.
    fn observe(&mut self, gate: Signal) {
        let width = self.graph.width;
        let places = self.graph.nodes.len();
        self.flipped.resize(places * width, 0);
        self.changed.clear();
        self.changed.resize(places, false);
        self.after.clear();
        self.after.resize(places, false);
        for (i, &value) in self.graph.values(gate).iter().enumerate() {
            self.flipped[gate as usize * width + i] = !value;
        }
        self.changed[gate as usize] = true;
        self.after[gate as usize] = true;
        for i in self.graph.position(gate) + 1..self.graph.order.len() {
            let signal = self.graph.order[i];
            let [a, b] = self.graph.node(signal).pins;
            self.after[signal as usize] = self.after[a as usize] || self.after[b as usize];
            if self.changed[a as usize] || self.changed[b as usize] {
                self.changed[signal as usize] = self.flip(signal, [a, b]);
            }
        }
        let Finder { on, off, .. } = &mut self.finder;
        on.clear();
        on.resize(width, 0);
        for &output in &self.graph.outputs {
            if self.changed[output as usize] {
                let flipped = &self.flipped[output as usize * width..][..width];
                for (i, (value, flipped)) in self.graph.values(output).iter().zip(flipped).enumerate() {
                    on[i] |= value ^ flipped;
                }
            }
        }
        let values = self.graph.values(gate);
        off.clear();
        off.extend(on.iter().zip(values).map(|(care, value)| care & !value));
        on.iter_mut().zip(values).for_each(|(care, value)| *care &= value);
    }

    fn flip(&mut self, signal: Signal, pins: [Signal; 2]) -> bool {
        let [a, b] = pins.map(|pin| match self.changed[pin as usize] {
            true => &self.flipped[pin as usize * self.graph.width..][..self.graph.width],
            false => self.graph.values(pin),
        });
        self.row.clear();
        self.row.extend(words(self.graph.node(signal).function, a, b));
        self.flipped[signal as usize * self.graph.width..][..self.graph.width].copy_from_slice(&self.row);
        self.row != self.graph.values(signal)
    }

    /// The candidate signals: those that do not depend on the gate or on a later loop.
    fn find_divisors(&mut self, gate: Signal) {
        let stage = self.graph.node(gate).stage;
        let sources = 2..self.graph.first_gate();
        let all = sources.chain(self.graph.order.iter().copied());
        let (after, graph) = (&self.after, &self.graph);
        self.finder.divisors.clear();
        self.finder.divisors.extend(all.filter(|&signal| !after[signal as usize] && graph.node(signal).stage <= stage));
    }

    fn choose(&mut self, gate: Signal, slack: i64) -> bool {
        let mut best: Option<(i64, Replacement)> = None;
        for tried in 0..TRIES.min(self.finder.found.len()) {
            let pick = tried + self.below(self.finder.found.len() - tried);
            self.finder.found.swap(tried, pick);
            let candidate = self.finder.found[tried];
            if let Some(change) = self.weigh(gate, candidate)
                && change <= slack
                && best.is_none_or(|(least, _)| change < least)
            {
                best = Some((change, candidate));
            }
        }
        best.is_some_and(|(_, candidate)| self.take(gate, candidate))
    }

    fn build(&mut self, candidate: Replacement) -> Option<Signal> {
        match candidate {
            Replacement::Signal(signal) => Some(signal),
            Replacement::One(function, pins) => self.graph.compose(function, pins),
            Replacement::Two(outer, other, function, pins) => {
                let inner = self.graph.compose(function, pins)?;
                let root = self.graph.compose(outer, [other, inner])?;
                self.graph.hold(root);
                self.graph.release(inner);
                self.graph.let_go(root);
                Some(root)
            }
        }
    }

    fn weigh(&mut self, gate: Signal, candidate: Replacement) -> Option<i64> {
        let before = i64::from(self.graph.cost);
        let root = self.build(candidate)?;
        let change = i64::from(self.graph.cost) - before - i64::from(self.hold_and_release(root, gate));
        let same = self.graph.node(root).alive && self.graph.same(root, gate);
        let late = self.limit.is_some_and(|limit| self.graph.node(root).arrival > limit);
        self.graph.release(root);
        (!same && !late).then_some(change)
    }

    fn hold_and_release(&mut self, root: Signal, gate: Signal) -> u32 {
        self.graph.hold(root);
        let released = self.graph.released(gate);
        self.graph.let_go(root);
        released
    }

    fn take(&mut self, gate: Signal, candidate: Replacement) -> bool {
        let Some(root) = self.build(candidate) else {
            return false;
        };
        self.graph.substitute(gate, root);
        self.graph.sort();
        self.graph.refresh(root);
        true
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use rand::SeedableRng;

    use super::*;
    use crate::cells::CellLibrary;
    use crate::example::network;
    use crate::proof::equal;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(60))]

        #[test]
        fn a_walk_that_sees_surroundings_only_keeps_the_function(
            gates in prop::collection::vec(any::<(u8, u16, u16)>(), 5..80),
            stages in prop::collection::vec(0u32..3, 14),
        ) {
            let source = network(14, &gates);
            let library = CellLibrary::uniform([Function::NAND, Function::AND, Function::NOT]);
            let prices = Prices::of(&library);
            let covered = crate::synth::reduce::cover(&source, &prices, &stages).unwrap();
            let mut random = ChaCha8Rng::seed_from_u64(1);
            let plan = WalkPlan::downhill(10 * gates.len() as u64);
            let walked = improve(&covered, &prices, &stages, &[], plan, &mut random);
            prop_assert!(equal(&source, &walked).is_ok());
            prop_assert!(walked.gates.len() <= covered.gates.len());
            let [before, after] = [&covered, &walked].map(|network| output_stages(network, &stages));
            prop_assert!(after.iter().zip(&before).all(|(after, before)| after <= before));
            let again = improve(&covered, &prices, &stages, &[], plan, &mut ChaCha8Rng::seed_from_u64(1));
            prop_assert_eq!(walked, again);
        }
    }

    fn output_stages(network: &Network, inputs: &[u32]) -> Vec<u32> {
        let mut stages = vec![0, 0];
        stages.extend(inputs);
        for gate in &network.gates {
            stages.push(gate.pins.map(|pin| stages[pin as usize]).into_iter().max().unwrap_or(0));
        }
        network.outputs.iter().map(|&output| stages[output as usize]).collect()
    }

    #[test]
    fn surroundings_show_dont_cares_through_later_gates() {
        // The exclusive or matters only if `a` is 1: there it is the opposite of `b`.
        let mut network = Network::new(20);
        let different = network.add(Function::XOR, [2, 3]);
        let both = network.add(Function::AND, [2, different]);
        network.outputs.push(both);
        let all = Function::all().filter(|function| function.arity() == 2);
        let prices = Prices::of(&CellLibrary::uniform(all));
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let walked = improve(&network, &prices, &[], &[], WalkPlan::downhill(20), &mut random);
        assert_eq!(walked.gates.len(), 1);
    }
}
