//! The search: a random walk over networks that compute the same outputs. Each step replaces one gate by another
//! function of other signals that agrees wherever the gate matters (resubstitution under observability don't-cares). It
//! never makes the network more expensive, except for rare steps up at a small temperature. Steps of equal cost are
//! accepted, because they lead out of local optima.

use rand_chacha::ChaCha8Rng;

use crate::circuit::network::{Network, Signal, word};
use crate::circuit::synth::graph::{Graph, every_pattern};
use crate::circuit::synth::prices::Prices;
use crate::model::Function;

/// The length and the temperature of the search.
#[derive(Clone, Copy, Debug)]
pub struct WalkPlan {
    /// Gates to visit.
    pub visits: u64,
    /// One of this number of visits may make the network slightly more expensive; 0 for never.
    pub climb: u32,
    /// Visits without a new best after which the search returns to the best so far.
    pub patience: u64,
    /// Whether time matters, and how.
    pub pace: Pace,
}

/// The role of delay in the walk.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pace {
    /// Delay does not matter.
    #[default]
    Any,
    /// No output may become later.
    Keep,
    /// Gates on the slowest paths are made earlier at any cost.
    Hurry,
}

impl WalkPlan {
    /// A walk that never climbs and never turns back.
    pub fn calm(visits: u64) -> Self {
        Self { visits, climb: 0, patience: u64::MAX, pace: Pace::Any }
    }
}

/// Searches for a cheaper network of the same function; the patterns must be all that can occur.
pub fn improve(
    network: &Network,
    prices: &Prices,
    stages: &[u32],
    patterns: &[Vec<u64>],
    plan: WalkPlan,
    random: &mut ChaCha8Rng,
) -> Network {
    let graph = Graph::new(network, prices, stages, patterns);
    let mut walk = Walk::new(graph, plan.pace, random);
    if plan.pace == Pace::Hurry {
        (0..plan.visits).for_each(|_| walk.hurry());
        return walk.graph.network();
    }
    let mut best = walk.graph.network();
    let mut best_cost = walk.graph.cost();
    let mut best_at = 0;
    for visit in 0..plan.visits {
        if walk.graph.order().is_empty() {
            break;
        }
        let slack = u32::from(plan.climb > 0 && walk.below(plan.climb as usize) == 0);
        if walk.visit(slack) && walk.graph.cost() < best_cost {
            best = walk.graph.network();
            best_cost = walk.graph.cost();
            best_at = visit;
        } else if visit - best_at > plan.patience {
            walk.graph = Graph::new(&best, prices, stages, patterns);
            best_at = visit;
        }
    }
    if walk.graph.cost() == best_cost { walk.graph.network() } else { best }
}

/// As [`improve`], over every pattern of the inputs.
pub fn improve_all(
    network: &Network,
    prices: &Prices,
    stages: &[u32],
    plan: WalkPlan,
    random: &mut ChaCha8Rng,
) -> Network {
    improve(network, prices, stages, &every_pattern(network.inputs), plan, random)
}

/// A replacement of a gate: one function, or a function of a signal and of another function.
#[derive(Clone, Copy, Debug)]
enum Candidate {
    Signal(Signal),
    One(Function, [Signal; 2]),
    Two(Function, Signal, Function, [Signal; 2]),
}

/// A literal: a signal, maybe inverted.
type Literal = (Signal, bool);

/// The state of a walk, with room for its sums.
struct Walk<'p, 'r> {
    graph: Graph<'p>,
    pace: Pace,
    /// The time at which the outputs must be correct.
    deadline: u32,
    /// The latest arrival of a replacement of the visited gate.
    limit: u32,
    /// The required time of each gate.
    required: Vec<u32>,
    random: &'r mut ChaCha8Rng,
    /// Values with the visited gate inverted, for the signals marked as changed.
    flipped: Vec<u64>,
    changed: Vec<bool>,
    /// Whether a signal depends on the visited gate.
    after: Vec<bool>,
    on: Vec<u64>,
    off: Vec<u64>,
    divisors: Vec<Signal>,
    candidates: Vec<Candidate>,
    ands: Vec<Literal>,
    ors: Vec<Literal>,
    buckets: Vec<Vec<Signal>>,
}

/// The most candidates that are tried in a visit.
const TRIES: usize = 24;

/// The highest cost of making one gate earlier.
const HURRY_PRICE: u32 = 6;

/// Buckets of the table that finds exclusive ors.
const BUCKETS: usize = 256;

impl<'p, 'r> Walk<'p, 'r> {
    fn new(graph: Graph<'p>, pace: Pace, random: &'r mut ChaCha8Rng) -> Self {
        Self {
            deadline: graph.depth(),
            graph,
            pace,
            limit: u32::MAX,
            required: Vec::new(),
            random,
            flipped: Vec::new(),
            changed: Vec::new(),
            after: Vec::new(),
            on: Vec::new(),
            off: Vec::new(),
            divisors: Vec::new(),
            candidates: Vec::new(),
            ands: Vec::new(),
            ors: Vec::new(),
            buckets: vec![Vec::new(); BUCKETS],
        }
    }

    fn below(&mut self, bound: usize) -> usize {
        ((u64::from(rand::Rng::next_u32(self.random)) * bound as u64) >> 32) as usize
    }

    /// Visits a random gate; returns whether the network changed.
    fn visit(&mut self, slack: u32) -> bool {
        let at = self.below(self.graph.order().len());
        let gate = self.graph.order()[at];
        if self.pace == Pace::Keep {
            self.require();
            self.limit = self.required[gate as usize];
        }
        self.change(gate, slack)
    }

    /// Visits a random gate on a slowest path to make it earlier.
    fn hurry(&mut self) {
        self.deadline = self.graph.depth();
        self.require();
        let (graph, required) = (&self.graph, &self.required);
        let late = |&&gate: &&Signal| graph.node(gate).arrival >= required[gate as usize];
        let critical: Vec<Signal> = graph.order().iter().filter(late).copied().collect();
        if !critical.is_empty() {
            let gate = critical[self.below(critical.len())];
            self.limit = self.graph.node(gate).arrival - 1;
            self.change(gate, HURRY_PRICE);
        }
    }

    /// Computes the required time of each gate.
    fn require(&mut self) {
        self.required.clear();
        self.required.resize(self.graph.places(), self.deadline);
        for &gate in self.graph.order().iter().rev() {
            let node = self.graph.node(gate);
            let before = self.required[gate as usize].saturating_sub(self.graph.prices().clock(node.function));
            for pin in node.pins {
                self.required[pin as usize] = self.required[pin as usize].min(before);
            }
        }
    }

    /// Looks for a replacement of a gate that costs at most `slack`; returns whether the network changed.
    fn change(&mut self, gate: Signal, slack: u32) -> bool {
        self.observe(gate);
        self.find_divisors(gate);
        self.candidates.clear();
        let (on, off) = (std::mem::take(&mut self.on), std::mem::take(&mut self.off));
        self.find_candidates(&on, &off, None);
        if self.graph.released(gate) + slack >= 2 {
            self.find_deeper(&on, &off);
        }
        (self.on, self.off) = (on, off);
        self.graph.set_leaving(Some(gate));
        let changed = self.choose(gate, i64::from(slack));
        self.graph.set_leaving(None);
        changed
    }

    /// Finds the patterns in which the gate matters (`on`: and it is 1, `off`: and it is 0) and the gates that depend
    /// on it.
    fn observe(&mut self, gate: Signal) {
        let width = self.graph.width();
        let places = self.graph.places();
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
        for i in self.graph.position(gate) + 1..self.graph.order().len() {
            let signal = self.graph.order()[i];
            let [a, b] = self.graph.node(signal).pins;
            self.after[signal as usize] = self.after[a as usize] || self.after[b as usize];
            if self.changed[a as usize] || self.changed[b as usize] {
                self.changed[signal as usize] = self.flip(signal, [a, b]);
            }
        }
        self.on.clear();
        self.on.resize(width, 0);
        for &output in self.graph.outputs() {
            if self.changed[output as usize] {
                let flipped = &self.flipped[output as usize * width..][..width];
                for (i, (value, flipped)) in self.graph.values(output).iter().zip(flipped).enumerate() {
                    self.on[i] |= value ^ flipped;
                }
            }
        }
        let values = self.graph.values(gate);
        self.off.clear();
        self.off.extend(self.on.iter().zip(values).map(|(care, value)| care & !value));
        self.on.iter_mut().zip(values).for_each(|(care, value)| *care &= value);
    }

    /// Computes a gate with the visited one inverted; returns whether it changes.
    fn flip(&mut self, signal: Signal, pins: [Signal; 2]) -> bool {
        let width = self.graph.width();
        let function = self.graph.node(signal).function;
        let mut changed = 0;
        let out = signal as usize * width;
        for i in 0..width {
            let [a, b] = pins.map(|pin| {
                let at = pin as usize * width + i;
                if self.changed[pin as usize] { self.flipped[at] } else { self.graph.values(pin)[i] }
            });
            let value = word(function, a, b);
            changed |= value ^ self.graph.values(signal)[i];
            self.flipped[out + i] = value;
        }
        changed != 0
    }

    /// The candidate signals: those that do not depend on the gate or on a later loop.
    fn find_divisors(&mut self, gate: Signal) {
        let stage = self.graph.node(gate).stage;
        let sources = 2..self.graph.first_gate();
        let all = sources.chain(self.graph.order().iter().copied());
        self.divisors.clear();
        let (after, graph) = (&self.after, &self.graph);
        self.divisors.extend(all.filter(|&signal| !after[signal as usize] && graph.node(signal).stage <= stage));
    }

    /// Finds signals and functions of two signals that are 1 on `on` and 0 on `off`, `outer` being applied to them.
    fn find_candidates(&mut self, on: &[u64], off: &[u64], outer: Option<(Function, Signal)>) {
        self.ands.clear();
        self.ors.clear();
        if on.iter().all(|&word| word == 0) || off.iter().all(|&word| word == 0) {
            let constant = Signal::from(on.iter().any(|&word| word != 0));
            self.push_signal(constant, outer);
            return;
        }
        for i in 0..self.divisors.len() {
            let signal = self.divisors[i];
            let fits = fits(self.graph.values(signal), on, off);
            if fits.covers_on && fits.avoids_off {
                self.push_signal(signal, outer);
            }
            if fits.avoids_on && fits.covers_off {
                self.push(Function::NOT, [signal; 2], outer);
            }
            let literals = [
                (fits.covers_on, false, true),
                (fits.avoids_on, true, true),
                (fits.avoids_off, false, false),
                (fits.covers_off, true, false),
            ];
            for (_, inverted, and) in literals.into_iter().filter(|&(fits, ..)| fits) {
                if and { self.ands.push((signal, inverted)) } else { self.ors.push((signal, inverted)) }
            }
        }
        self.find_pairs(off, true, outer);
        self.find_pairs(on, false, outer);
        self.find_exclusive(on, off, outer);
    }

    /// Pairs of literals whose AND is 0 on `target`, or whose OR is 1 on `target`.
    fn find_pairs(&mut self, target: &[u64], and: bool, outer: Option<(Function, Signal)>) {
        let literals = std::mem::take(if and { &mut self.ands } else { &mut self.ors });
        let start = if literals.is_empty() { 0 } else { self.below(literals.len()) };
        let mut found = 0;
        'pairs: for i in 0..literals.len() {
            let one = literals[(start + i) % literals.len()];
            for j in 0..i {
                let two = literals[(start + j) % literals.len()];
                if self.pair_fits(one, two, target, and) {
                    self.push(pair_function(one.1, two.1, and), [one.0, two.0], outer);
                    found += 1;
                    if found > 4 * TRIES {
                        break 'pairs;
                    }
                }
            }
        }
        *(if and { &mut self.ands } else { &mut self.ors }) = literals;
    }

    fn pair_fits(&self, one: Literal, two: Literal, target: &[u64], and: bool) -> bool {
        let (a, b) = (self.graph.values(one.0), self.graph.values(two.0));
        // An OR is 1 on the target where the AND of the opposite literals is 0.
        let turn = |inverted: bool| if inverted == and { !0 } else { 0 };
        let (x, y) = (turn(one.1), turn(two.1));
        a.iter().zip(b).zip(target).all(|((a, b), target)| (a ^ x) & (b ^ y) & target == 0)
    }

    /// Pairs of signals whose exclusive or, or its opposite, fits.
    fn find_exclusive(&mut self, on: &[u64], off: &[u64], outer: Option<(Function, Signal)>) {
        let care = |i: usize| on[i] | off[i];
        let first = (0..on.len()).find(|&i| care(i) != 0).expect("the gate matters somewhere");
        let bit = care(first).trailing_zeros();
        let hash = |values: &[u64]| {
            let turn = if values[first] >> bit & 1 == 1 { !0 } else { 0 };
            (0..on.len()).fold(0u64, |hash, i| hash.rotate_left(23) ^ ((values[i] ^ turn) & care(i)))
        };
        let target = hash(on);
        let bucket = |hash: u64| (hash.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 56) as usize % BUCKETS;
        self.buckets.iter_mut().for_each(Vec::clear);
        for i in 0..self.divisors.len() {
            let signal = self.divisors[i];
            let own = hash(self.graph.values(signal));
            for j in 0..self.buckets[bucket(own ^ target)].len() {
                let other = self.buckets[bucket(own ^ target)][j];
                if let Some(function) = self.exclusive_fits(signal, other, on, off) {
                    self.push(function, [signal, other], outer);
                }
            }
            self.buckets[bucket(own)].push(signal);
        }
    }

    fn exclusive_fits(&self, one: Signal, two: Signal, on: &[u64], off: &[u64]) -> Option<Function> {
        let (a, b) = (self.graph.values(one), self.graph.values(two));
        let (mut xor, mut xnor) = (true, true);
        for i in 0..on.len() {
            let differ = a[i] ^ b[i];
            xor &= differ & off[i] == 0 && !differ & on[i] == 0;
            xnor &= differ & on[i] == 0 && !differ & off[i] == 0;
            if !xor && !xnor {
                return None;
            }
        }
        Some(if xor { Function::XOR } else { Function::XNOR })
    }

    /// Fixes one literal of a random shape, and looks for the others.
    fn find_deeper(&mut self, on: &[u64], off: &[u64]) {
        if self.divisors.is_empty() {
            return;
        }
        for shape in 0..3 {
            let pick = rand::Rng::next_u32(self.random) as usize;
            let (outer, rest_on, rest_off): (_, Vec<u64>, Vec<u64>) = match shape {
                0 if !self.ands.is_empty() => {
                    let (signal, inverted) = self.ands[pick % self.ands.len()];
                    let turn = if inverted { !0 } else { 0 };
                    let values = self.graph.values(signal);
                    let rest = off.iter().zip(values).map(|(off, value)| off & (value ^ turn)).collect();
                    ((pair_function(inverted, false, true), signal), on.to_vec(), rest)
                }
                1 if !self.ors.is_empty() => {
                    let (signal, inverted) = self.ors[pick % self.ors.len()];
                    let turn = if inverted { 0 } else { !0 };
                    let values = self.graph.values(signal);
                    let rest = on.iter().zip(values).map(|(on, value)| on & (value ^ turn)).collect();
                    ((pair_function(inverted, false, false), signal), rest, off.to_vec())
                }
                2 => {
                    let signal = self.divisors[pick % self.divisors.len()];
                    let values = self.graph.values(signal);
                    let turned = |to: &[u64], from: &[u64]| {
                        (0..on.len()).map(|i| to[i] & !values[i] | from[i] & values[i]).collect()
                    };
                    ((Function::XOR, signal), turned(on, off), turned(off, on))
                }
                _ => continue,
            };
            let literals = (self.ands.clone(), self.ors.clone());
            self.find_candidates(&rest_on, &rest_off, Some(outer));
            (self.ands, self.ors) = literals;
        }
    }

    fn push_signal(&mut self, signal: Signal, outer: Option<(Function, Signal)>) {
        self.candidates.push(match outer {
            None => Candidate::Signal(signal),
            Some((function, other)) => Candidate::One(function, [other, signal]),
        });
    }

    fn push(&mut self, function: Function, pins: [Signal; 2], outer: Option<(Function, Signal)>) {
        self.candidates.push(match outer {
            None => Candidate::One(function, pins),
            Some((outer, other)) => Candidate::Two(outer, other, function, pins),
        });
    }

    /// Tries candidates in random order, and uses the best one that adds at most `slack` to the cost.
    fn choose(&mut self, gate: Signal, slack: i64) -> bool {
        let mut best: Option<(i64, Candidate)> = None;
        for tried in 0..TRIES.min(self.candidates.len()) {
            let pick = tried + self.below(self.candidates.len() - tried);
            self.candidates.swap(tried, pick);
            let candidate = self.candidates[tried];
            if let Some(change) = self.weigh(gate, candidate)
                && change <= slack
                && best.is_none_or(|(least, _)| change < least)
            {
                best = Some((change, candidate));
            }
        }
        best.is_some_and(|(_, candidate)| self.take(gate, candidate))
    }

    fn build(&mut self, candidate: Candidate) -> Option<Signal> {
        match candidate {
            Candidate::Signal(signal) => Some(signal),
            Candidate::One(function, pins) => self.graph.compose(function, pins),
            Candidate::Two(outer, other, function, pins) => {
                let inner = self.graph.compose(function, pins)?;
                let root = self.graph.compose(outer, [other, inner])?;
                self.graph.hold(root);
                self.graph.release(inner);
                self.graph.let_go(root);
                Some(root)
            }
        }
    }

    /// The added cost of the network; `None` if nothing would change.
    fn weigh(&mut self, gate: Signal, candidate: Candidate) -> Option<i64> {
        let before = i64::from(self.graph.cost());
        let root = self.build(candidate)?;
        let change = i64::from(self.graph.cost()) - before - i64::from(self.hold_and_release(root, gate));
        let same = self.graph.node(root).alive && self.graph.same(root, gate);
        let late = self.graph.node(root).arrival > self.limit;
        self.graph.release(root);
        (!same && !late).then_some(change)
    }

    /// The cost released by removing the gate while `root` stays.
    fn hold_and_release(&mut self, root: Signal, gate: Signal) -> u32 {
        self.graph.hold(root);
        let released = self.graph.released(gate);
        self.graph.let_go(root);
        released
    }

    fn take(&mut self, gate: Signal, candidate: Candidate) -> bool {
        let Some(root) = self.build(candidate) else {
            return false;
        };
        self.graph.substitute(gate, root);
        self.graph.sort();
        self.graph.refresh();
        true
    }
}

/// The function of two signals that is the AND (or the OR) of two literals of them.
fn pair_function(one: bool, two: bool, and: bool) -> Function {
    let mut function = if and { Function::AND } else { Function::OR };
    for (pin, inverted) in [one, two].into_iter().enumerate() {
        function = if inverted { function.with_input_inverted(pin) } else { function };
    }
    function
}

/// The relation of a signal to the patterns in which a 1 or a 0 is wrong.
struct Fits {
    covers_on: bool,
    avoids_on: bool,
    covers_off: bool,
    avoids_off: bool,
}

fn fits(values: &[u64], on: &[u64], off: &[u64]) -> Fits {
    let (mut one_on, mut zero_on, mut one_off, mut zero_off) = (0, 0, 0, 0);
    for i in 0..values.len() {
        one_on |= values[i] & on[i];
        zero_on |= !values[i] & on[i];
        one_off |= values[i] & off[i];
        zero_off |= !values[i] & off[i];
        if one_on != 0 && zero_on != 0 && one_off != 0 && zero_off != 0 {
            break;
        }
    }
    Fits { covers_on: zero_on == 0, avoids_on: one_on == 0, covers_off: zero_off == 0, avoids_off: one_off == 0 }
}
