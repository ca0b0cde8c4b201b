//! Exact synthesis of functions of up to three inputs: sequences of cells are tried in order of their length, until one
//! makes every output. If none is found, none exists.
//!
//! Each set of cells is tried in one order only, the number of unused values must be small enough to use them all, and
//! interchangeable inputs are distinguished by the first cell (Knuth, The Art of Computer Programming 7.1.2, for the
//! principle).

use crate::CancelFlag;
use crate::network::{Network, Signal, counting_word};
use crate::synth::prices::Prices;
use nbc_base::model::Function;

pub(crate) const MOST_INPUTS: usize = 3;

const MOST_CELLS: usize = 24;

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ExactResult {
    Made(Network),
    Impossible,
    Unknown,
}

/// The minimal number of cells, below `below`, after at most `nodes` partial sequences. All cells have the same cost.
pub fn fewer(network: &Network, prices: &Prices, below: u32, nodes: u64, cancel: &CancelFlag) -> ExactResult {
    let outputs = truths(network);
    let given = &START[..2 + network.inputs];
    let mut targets: Vec<u8> = outputs.iter().copied().filter(|truth| !given.contains(truth)).collect();
    targets.sort_unstable();
    targets.dedup();
    let operations = Operation::all(prices);
    let mut search = Search::new(given, &targets, &operations, nodes, cancel);
    let least = targets.len() as u32;
    for cells in least..below.min(MOST_CELLS as u32) {
        if search.extend(cells) {
            return ExactResult::Made(search.network(&outputs));
        }
        if search.is_over() {
            return ExactResult::Unknown;
        }
    }
    ExactResult::Impossible
}

fn truths(network: &Network) -> Vec<u8> {
    assert!(network.inputs <= MOST_INPUTS, "an exact search has few inputs");
    let inputs: Vec<u64> = (0..network.inputs).map(|i| counting_word(i, 0)).collect();
    let values = network.simulate(&inputs);
    network.outputs.iter().map(|&output| values[output as usize] as u8).collect()
}

/// The values before the first cell: both constants and the inputs, in the order of a network's signals.
const START: [u8; 2 + MOST_INPUTS] = [0x00, 0xff, 0xaa, 0xcc, 0xf0];

#[derive(Clone, Copy, Debug)]
struct Operation {
    effect: Function,
    cell: Function,
    pins: [Pin; 2],
}

#[derive(Clone, Copy, Debug)]
enum Pin {
    First,
    Second,
    Constant(bool),
}

impl Operation {
    fn all(prices: &Prices) -> Vec<Self> {
        let pins = [Pin::First, Pin::Second, Pin::Constant(false), Pin::Constant(true)];
        let cells = || Function::all().filter(|&function| prices.cell(function) > 0);
        let own = cells().map(|cell| (cell, [Pin::First, Pin::Second]));
        let wired = cells().flat_map(|cell| pins.map(|a| pins.map(|b| (cell, [a, b]))).concat());
        let mut all: Vec<Self> = Vec::new();
        for (cell, pins) in own.chain(wired) {
            let bits = |pin| match pin {
                Pin::First => 0b1100,
                Pin::Second => 0b1010,
                Pin::Constant(value) => 0b1111 * u8::from(value),
            };
            let effect = Function::new(crate::cells::compose(cell, bits(pins[0]), bits(pins[1])));
            let new = effect == Function::NOT || effect.arity() == 2;
            if new && all.iter().all(|known| known.effect != effect) {
                all.push(Self { effect, cell, pins });
            }
        }
        all
    }
}

type Set = [u64; 4];

fn holds(set: &Set, value: u8) -> bool {
    set[usize::from(value >> 6)] >> (value & 63) & 1 == 1
}

fn insert(set: &mut Set, value: u8) {
    set[usize::from(value >> 6)] |= 1 << (value & 63);
}

fn apply(function: Function, a: u8, b: u8) -> u8 {
    crate::network::word(function, a.into(), b.into()) as u8
}

type Step = (Operation, [usize; 2]);

struct Search<'a> {
    given: &'a [u8],
    targets: &'a [u8],
    pairs: Vec<Operation>,
    inverter: Option<Operation>,
    values: Vec<u8>,
    steps: Vec<Step>,
    made: Set,
    /// The positions of cells that no cell reads and that are not targets.
    unused: u32,
    /// For a single target: the values that make it together with each value, as far as computed.
    closing: Vec<Option<Set>>,
    least: Set,
    nodes: u64,
    cancel: &'a CancelFlag,
}

impl<'a> Search<'a> {
    fn new(given: &'a [u8], targets: &'a [u8], operations: &[Operation], nodes: u64, cancel: &'a CancelFlag) -> Self {
        let mut made = Set::default();
        given.iter().for_each(|&value| insert(&mut made, value));
        Self {
            given,
            targets,
            inverter: operations.iter().copied().find(|one| one.effect == Function::NOT),
            pairs: operations.iter().copied().filter(|one| one.effect.arity() == 2).collect(),
            values: given.to_vec(),
            steps: Vec::new(),
            made,
            unused: 0,
            closing: vec![None; 256],
            least: least_images(targets),
            nodes,
            cancel,
        }
    }

    fn is_over(&self) -> bool {
        self.nodes == 0 || self.cancel.is_raised()
    }

    fn extend(&mut self, left: u32) -> bool {
        let missing = self.targets.iter().filter(|&&target| !holds(&self.made, target)).count() as u32;
        if missing == 0 {
            return self.unused == 0;
        }
        if missing > left || self.is_over() || left == 2 && self.targets.len() == 1 && !self.can_close() {
            return false;
        }
        self.nodes -= 1;
        // Each cell uses up at most two values, and all values except the missing targets must be used.
        let may_stay = left + missing - 2;
        for i in 2..self.values.len() {
            let used = self.unused & !(1 << i);
            if let Some(inverter) = self.inverter
                && used.count_ones() <= may_stay
                && self.append(inverter, [i, i], left, missing)
            {
                return true;
            }
            for j in 2..i {
                let fits = (used & !(1 << j)).count_ones() <= may_stay;
                if fits && (0..self.pairs.len()).any(|k| self.append(self.pairs[k], [i, j], left, missing)) {
                    return true;
                }
            }
        }
        false
    }

    fn append(&mut self, operation: Operation, pins: [usize; 2], left: u32, missing: u32) -> bool {
        let [a, b] = pins.map(|pin| self.values[pin]);
        let value = apply(operation.effect, a, b);
        let last = self.values.len() - 1;
        let in_order = match last >= self.given.len() {
            true => pins.contains(&last) || value > self.values[last],
            false => holds(&self.least, value),
        };
        let target = self.targets.contains(&value);
        if holds(&self.made, value) || !in_order || left == missing && !target {
            return false;
        }
        let (made, unused) = (self.made, self.unused);
        insert(&mut self.made, value);
        self.unused &= !(1 << pins[0] | 1 << pins[1]);
        self.unused |= u32::from(!target) << self.values.len();
        self.values.push(value);
        self.steps.push((operation, pins));
        let found = self.extend(left - 1);
        if !found {
            self.values.pop();
            self.steps.pop();
            (self.made, self.unused) = (made, unused);
        }
        found
    }

    /// Whether two cells may make the only target: the first must make a value from which the second makes it.
    fn can_close(&mut self) -> bool {
        self.prepare_closing();
        let places = self.given.len()..self.values.len();
        let unused: Vec<usize> = places.filter(|&place| self.unused >> place & 1 == 1).collect();
        let any = || 2..self.values.len();
        let all = self.closing_any();
        let last = |place: usize| self.closing_with(place);
        match unused[..] {
            [] => any().any(|i| self.one_makes(i, 2..i + 1, &all)),
            [p] => self.one_makes(p, any(), &all) || any().any(|i| i != p && self.one_makes(i, 2..i + 1, last(p))),
            [p, q] => {
                self.one_makes(p, q..q + 1, &all)
                    || self.one_makes(p, any(), last(q))
                    || self.one_makes(q, any(), last(p))
            }
            [p, q, r] => {
                let splits = [[p, q, r], [p, r, q], [q, r, p]];
                splits.into_iter().any(|[i, j, k]| self.one_makes(i, j..j + 1, last(k)))
            }
            _ => false,
        }
    }

    fn one_makes(&self, i: usize, mut others: std::ops::Range<usize>, set: &Set) -> bool {
        let a = self.values[i];
        others.any(|j| match i == j {
            true => self.inverter.is_some() && holds(set, !a),
            false => self.pairs.iter().any(|pair| holds(set, apply(pair.effect, a, self.values[j]))),
        })
    }

    fn prepare_closing(&mut self) {
        for &value in &self.values[2..] {
            self.closing[usize::from(value)].get_or_insert_with(|| closing(&self.pairs, self.targets[0], value));
        }
    }

    fn closing_with(&self, place: usize) -> &Set {
        self.closing[usize::from(self.values[place])].as_ref().expect("values are prepared before they are asked for")
    }

    fn closing_any(&self) -> Set {
        let mut any = Set::default();
        for place in 2..self.values.len() {
            let set = self.closing_with(place);
            (0..4).for_each(|i| any[i] |= set[i]);
        }
        if self.inverter.is_some() {
            insert(&mut any, !self.targets[0]);
        }
        any
    }

    fn network(&self, outputs: &[u8]) -> Network {
        let mut network = Network::new(self.given.len() - 2);
        let mut signals: Vec<Signal> = (0..self.given.len() as Signal).collect();
        for (operation, pins) in &self.steps {
            let signal = |pin| match pin {
                Pin::First => signals[pins[0]],
                Pin::Second => signals[pins[1]],
                Pin::Constant(value) => Signal::from(value),
            };
            signals.push(network.add(operation.cell, operation.pins.map(signal)));
        }
        let place = |truth| self.values.iter().position(|value| value == truth).expect("every output is made");
        network.outputs = outputs.iter().map(|truth| signals[place(truth)]).collect();
        network
    }
}

fn closing(pairs: &[Operation], target: u8, value: u8) -> Set {
    let mut set = Set::default();
    for other in 0..=255u8 {
        if pairs.iter().any(|pair| apply(pair.effect, other, value) == target) {
            insert(&mut set, other);
        }
    }
    set
}

const EXCHANGES: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];

fn exchanged(order: &[usize; 3], value: u8) -> u8 {
    let place = |row: usize| (0..3).fold(0, |place, i| place | (row >> order[i] & 1) << i);
    (0..8).fold(0, |image, row| image | (value >> place(row) & 1) << row)
}

/// The values that are minimal among their images under the permutations of inputs that keep every target.
fn least_images(targets: &[u8]) -> Set {
    let keeps = |order: &&[usize; 3]| targets.iter().all(|&target| exchanged(order, target) == target);
    let kept: Vec<_> = EXCHANGES.iter().filter(keeps).collect();
    let least = |&value: &u8| kept.iter().all(|order| exchanged(order, value) >= value);
    let mut set = Set::default();
    (0..=255).filter(least).for_each(|value| insert(&mut set, value));
    set
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::example::library;

    fn fewest(cells: &str, targets: &[u8]) -> usize {
        let library = library(cells);
        let prices = Prices::of(&library);
        let network = wanted(targets);
        let ExactResult::Made(made) = fewer(&network, &prices, MOST_CELLS as u32, u64::MAX, &CancelFlag::default())
        else {
            panic!("a complete library makes every function");
        };
        assert_eq!(truths(&made), targets);
        assert!(made.gates.iter().all(|gate| library.get(gate.function).is_some()));
        made.gates.len()
    }

    fn wanted(targets: &[u8]) -> Network {
        let mut network = Network::new(3);
        for target in targets {
            let mut sum = 0;
            for row in (0..8).filter(|row| target >> row & 1 == 1) {
                let product = (0..3).fold(1, |product, i| {
                    let literal = if row >> i & 1 == 1 { Function::AND } else { Function::AND.with_input_inverted(1) };
                    network.add(literal, [product, network.input(i)])
                });
                sum = network.add(Function::OR, [sum, product]);
            }
            network.outputs.push(sum);
        }
        network
    }

    #[test]
    fn known_optima_are_found() {
        let (sum, carry) = (0x96, 0xe8);
        assert_eq!(fewest("nand", &[sum]), 8);
        assert_eq!(fewest("nand and not", &[carry]), 5);
        assert_eq!(fewest("nand", &[0x66, 0x88]), 5);
        assert_eq!(fewest("xor and or", &[sum, carry]), 5);
        assert_eq!(fewest("nor", &[0x00, 0xaa, 0x55]), 1);
    }

    /// Functions that differ by an exchange of inputs need the same number of cells.
    fn total(cells: &str) -> usize {
        let images = |truth| EXCHANGES.iter().map(|order| exchanged(order, truth)).collect::<BTreeSet<u8>>();
        let classes = (1..=254).map(images).collect::<BTreeSet<_>>();
        classes.iter().map(|class| class.len() * fewest(cells, &[*class.first().unwrap()])).sum()
    }

    #[test]
    fn all_functions_of_three_inputs_need_the_number_of_cells_proved_by_sat() {
        assert_eq!(total("nand not"), 1318);
        assert_eq!(total("nand and or nor xor xnor not a_and_notb nota_and_b a_or_notb nota_or_b"), 597);
    }

    #[test]
    fn a_function_and_its_dual_need_equally_many_cells_of_dual_libraries() {
        let dual = |truth: u8| !truth.reverse_bits();
        for (cells, duals) in [("nand", "nor"), ("xor and", "xnor or"), ("a_and_notb or", "nota_or_b and")] {
            for truth in [0x01, 0x16, 0x68, 0xca, 0xe8] {
                assert_eq!(fewest(cells, &[truth]), fewest(duals, &[dual(truth)]), "{truth:02x} of {cells}");
            }
        }
    }

    #[test]
    fn impossible_and_aborted_searches_are_distinguished() {
        let (never, now) = (CancelFlag::default(), CancelFlag::default());
        now.raise();
        let prices = Prices::of(&library("nand"));
        assert_eq!(fewer(&wanted(&[0x96]), &prices, 8, u64::MAX, &never), ExactResult::Impossible);
        assert_eq!(fewer(&wanted(&[0x96]), &prices, 9, 100, &never), ExactResult::Unknown);
        assert_eq!(fewer(&wanted(&[0x96]), &prices, 9, u64::MAX, &now), ExactResult::Unknown);
    }
}
