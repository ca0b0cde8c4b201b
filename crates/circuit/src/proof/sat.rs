//! Comparison of two networks by SAT: gates that agree in simulation are proved equal from the inputs on and merged, so
//! that the outputs are easy in the end (SAT sweeping).

use std::collections::{BTreeMap, BTreeSet};

use batsat::{Lit, Solver, SolverInterface, SolverOpts, lbool};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use crate::network::{Gate, Network, Signal, inverted, words};
use crate::proof::method::{Method, random_word};
use crate::properties::{Solved, SolverLimits};
use nbc_base::model::Function;
use nbc_base::source::CancelFlag;

const WORDS: usize = 32;

/// Patterns that are simulated together.
const BATCH: usize = 16;
/// Of these, patterns in one word of 64 bits. The other bits are patterns that differ little from them.
const IN_A_WORD: usize = 4;

/// The most clauses learned to merge two gates: what is hard to see there may be easy at the outputs.
const GATE_PORTION: u64 = 1_000;

/// When to replace a solver: a pattern costs time for each variable, and most of what it learned is proved already.
const MOST_CALLS: usize = 100;
const MANY_VARIABLES: usize = 1_000;

pub fn equal(one: &Network, two: &Network) -> Result<Method, (usize, Vec<bool>)> {
    let mut comparison = Comparison::with(one);
    comparison.compare(two)?;
    Ok(Method::Sat { calls: comparison.sweep.calls })
}

/// The comparison of networks with one network. What is proved of a network helps to compare the next.
pub struct Comparison {
    sweep: SatSweep,
    outputs: Vec<(Signal, bool)>,
}

impl Comparison {
    pub fn with(network: &Network) -> Self {
        let mut sweep = SatSweep::new(network.inputs);
        let signals = sweep.add(network);
        Self { outputs: network.outputs.iter().map(|&output| signals[output as usize]).collect(), sweep }
    }

    pub fn compare(&mut self, network: &Network) -> Result<(), (usize, Vec<bool>)> {
        let signals = self.sweep.add(network);
        for (output, (&a, &b)) in self.outputs.iter().zip(&network.outputs).enumerate() {
            if let Some(inputs) = self.sweep.difference(a, signals[b as usize]) {
                return Err((output, inputs));
            }
        }
        Ok(())
    }

    pub fn work(&self) -> [u64; 2] {
        [self.sweep.calls as u64, self.sweep.propagations + self.sweep.cones.propagations()]
    }

    pub fn signals(&self) -> usize {
        self.sweep.values.len()
    }
}

pub struct SatSweep {
    cones: Cones,
    propagations: u64,
    /// The input words so far, `patterns[word][input]`.
    patterns: Vec<Vec<u64>>,
    inputs: usize,
    gates: Vec<Gate>,
    /// The values of each signal, `values[signal][word]`.
    values: Vec<Vec<u64>>,
    hashes: Vec<u64>,
    found: Vec<Vec<bool>>,
    /// The signals that represent a class by their hashes, in order. Those of equal hashes are known to be different.
    classes: BTreeMap<u64, Vec<Signal>>,
    /// The signal of each gate, by its function and pins as one number.
    known: BTreeMap<u128, (Signal, bool)>,
    pub calls: usize,
    portion: u64,
    cancel: CancelFlag,
}

pub enum Compared {
    Equal,
    Different(Vec<bool>),
    Open,
}

impl SatSweep {
    pub fn new(inputs: usize) -> Self {
        Self::limited(inputs, u64::MAX, CancelFlag::default())
    }

    /// The same with a solver that learns at most so many clauses in a call, and ends when the flag is raised.
    pub fn limited(inputs: usize, portion: u64, cancel: CancelFlag) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(0x6e62_6370_726f_6f66);
        let patterns = (0..WORDS).map(|word| (0..inputs).map(|_| random_word(word, &mut random)).collect()).collect();
        let mut sweep = Self {
            cones: Cones::new(&cancel),
            propagations: 0,
            portion,
            cancel,
            patterns,
            inputs,
            gates: Vec::new(),
            values: Vec::new(),
            hashes: Vec::new(),
            found: Vec::new(),
            classes: BTreeMap::new(),
            known: BTreeMap::new(),
            calls: 0,
        };
        sweep.values = (0..2 + inputs).map(|signal| sweep.source_values(signal, 0)).collect();
        sweep.hashes = sweep.values.iter().map(|values| hash(values)).collect();
        sweep.classify((0..sweep.values.len() as Signal).filter(|&signal| signal != 1).collect());
        sweep
    }

    fn source_values(&self, signal: usize, from: usize) -> Vec<u64> {
        let words = &self.patterns[from..];
        match signal {
            0 => vec![0; words.len()],
            1 => vec![!0; words.len()],
            _ => words.iter().map(|inputs| inputs[signal - 2]).collect(),
        }
    }

    pub fn add(&mut self, network: &Network) -> Vec<(Signal, bool)> {
        let mut made: Vec<(Signal, bool)> = (0..2 + network.inputs as Signal).map(|signal| (signal, false)).collect();
        for gate in &network.gates {
            let [a, b] = gate.pins.map(|pin| made[pin as usize]);
            let function = inverted(gate.function, [a.1, b.1]);
            let (function, pins) = if a.0 <= b.0 { (function, [a.0, b.0]) } else { (function.swapped(), [b.0, a.0]) };
            let key = pins.iter().fold(u128::from(function.bits()), |key, &pin| key << 32 | u128::from(pin));
            let known = self.known.get(&key).copied().unwrap_or_else(|| {
                let found = self.gate(function, pins);
                self.known.insert(key, found);
                found
            });
            made.push(known);
        }
        made
    }

    fn gate(&mut self, function: Function, pins: [Signal; 2]) -> (Signal, bool) {
        let signal = self.values.len() as Signal;
        let [a, b] = pins.map(|pin| &self.values[pin as usize]);
        let values: Vec<u64> = words(function, a, b).collect();
        self.hashes.push(hash(&values));
        self.values.push(values);
        self.gates.push(Gate { function, pins });
        let hash = self.hashes[signal as usize];
        for class in self.classes.get(&hash).cloned().unwrap_or_default() {
            let opposite = self.is_turned(signal) != self.is_turned(class);
            match self.compared_within((class, opposite), (signal, false), self.portion.min(GATE_PORTION)) {
                Compared::Equal => return (class, opposite),
                Compared::Different(pattern) => self.found.push(pattern),
                Compared::Open => {}
            }
        }
        self.classes.entry(hash).or_default().push(signal);
        if self.found.len() >= BATCH {
            self.learn();
        }
        (signal, false)
    }

    fn is_turned(&self, signal: Signal) -> bool {
        self.values[signal as usize][0] & 1 == 1
    }

    pub fn difference(&mut self, one: (Signal, bool), two: (Signal, bool)) -> Option<Vec<bool>> {
        match self.compared(one, two) {
            Compared::Equal => None,
            Compared::Different(inputs) => Some(inputs),
            Compared::Open => panic!("a solver without limits ends with an answer"),
        }
    }

    pub fn compared(&mut self, one: (Signal, bool), two: (Signal, bool)) -> Compared {
        self.compared_within(one, two, self.portion)
    }

    fn compared_within(&mut self, one: (Signal, bool), two: (Signal, bool), portion: u64) -> Compared {
        if one == two {
            return Compared::Equal;
        }
        for value in [false, true] {
            match self.solve(&[(one, value), (two, !value)], portion) {
                Solved::Yes => return Compared::Different(self.inputs_found()),
                Solved::No => {}
                Solved::Open => return Compared::Open,
            }
        }
        Compared::Equal
    }

    fn inputs_found(&self) -> Vec<bool> {
        (0..self.inputs).map(|input| self.cones.is_on(input as Signal + 2)).collect()
    }

    fn solve(&mut self, wanted: &[((Signal, bool), bool)], portion: u64) -> Solved {
        self.calls += 1;
        if self.cones.calls >= MOST_CALLS && self.cones.variable.len() > MANY_VARIABLES {
            self.propagations += self.cones.propagations();
            self.cones = Cones::new(&self.cancel);
        }
        let assumed: Vec<_> = wanted.iter().map(|&((signal, inverted), value)| (signal, value != inverted)).collect();
        let first_gate = 2 + self.inputs;
        let gate = |signal: Signal| (signal as usize).checked_sub(first_gate).map(|at| self.gates[at]);
        self.cones.solve(&assumed, gate, portion)
    }

    fn learn(&mut self) {
        let found = std::mem::take(&mut self.found);
        for patterns in found.chunks(IN_A_WORD) {
            let share = 64 / IN_A_WORD;
            let word = |input: usize| {
                let one = |(at, pattern): (usize, &Vec<bool>)| {
                    let same = if pattern[input] { (1 << share) - 1 } else { 0 };
                    (same ^ 2 << (input % (share - 1))) << (at * share)
                };
                patterns.iter().enumerate().map(one).fold(0, |word: u64, bits: u64| word | bits)
            };
            self.patterns.push((0..self.inputs).map(word).collect());
        }
        let known = self.values[0].len();
        for signal in 0..self.values.len() {
            let mut words: Vec<u64> = match signal.checked_sub(2 + self.inputs) {
                None => self.source_values(signal, known),
                Some(i) => {
                    let Gate { function, pins } = self.gates[i];
                    let [a, b] = pins.map(|pin| &self.values[pin as usize][known..]);
                    words(function, a, b).collect()
                }
            };
            let turn = if self.is_turned(signal as Signal) { !0 } else { 0 };
            self.hashes[signal] = words.iter().fold(self.hashes[signal], |hash, word| extended(hash, word ^ turn));
            self.values[signal].append(&mut words);
        }
        let mut members: Vec<Signal> = std::mem::take(&mut self.classes).into_values().flatten().collect();
        members.sort_unstable();
        self.classify(members);
    }

    fn classify(&mut self, members: Vec<Signal>) {
        for signal in members {
            self.classes.entry(self.hashes[signal as usize]).or_default().push(signal);
        }
    }
}

struct Cones {
    solver: Solver<SolverLimits>,
    variable: BTreeMap<Signal, Lit>,
    defined: BTreeSet<Signal>,
    calls: usize,
}

impl Cones {
    fn new(cancel: &CancelFlag) -> Self {
        let solver = Solver::new(SolverOpts::default(), SolverLimits::new(cancel.clone()));
        Self { solver, variable: BTreeMap::new(), defined: BTreeSet::new(), calls: 0 }
    }

    fn propagations(&self) -> u64 {
        self.solver.num_propagations()
    }

    fn solve(&mut self, wanted: &[(Signal, bool)], gate: impl Fn(Signal) -> Option<Gate>, portion: u64) -> Solved {
        self.calls += 1;
        let mut waiting: Vec<Signal> = wanted.iter().map(|&(signal, _)| signal).collect();
        while let Some(signal) = waiting.pop() {
            if !self.defined.insert(signal) {
                continue;
            }
            match gate(signal) {
                None if signal < 2 => self.clause(&[(signal, signal == 1)]),
                None => _ = self.literal((signal, true)),
                Some(Gate { function, pins }) => {
                    self.define(signal, function, pins);
                    waiting.extend(pins);
                }
            }
        }
        let assumed: Vec<Lit> = wanted.iter().map(|&wanted| self.literal(wanted)).collect();
        self.solver.cb_mut().permit(portion);
        match self.solver.solve_limited(&assumed) {
            solved if solved == lbool::TRUE => Solved::Yes,
            solved if solved == lbool::FALSE => Solved::No,
            _ => Solved::Open,
        }
    }

    /// Whether a signal is 1 in what was found last. One that the solver does not have may be either.
    fn is_on(&self, signal: Signal) -> bool {
        self.variable.get(&signal).is_some_and(|&literal| self.solver.value_lit(literal) == lbool::TRUE)
    }

    fn literal(&mut self, (signal, value): (Signal, bool)) -> Lit {
        let next = self.variable.len() as u32;
        let positive = *self.variable.entry(signal).or_insert_with(|| Lit::new(self.solver.var_of_int(next), true));
        if value { positive } else { !positive }
    }

    fn clause(&mut self, clause: &[(Signal, bool)]) {
        let mut literals: Vec<Lit> = clause.iter().map(|&one| self.literal(one)).collect();
        self.solver.add_clause_reuse(&mut literals);
    }

    fn define(&mut self, signal: Signal, function: Function, [a, b]: [Signal; 2]) {
        for (x, y) in [(false, false), (false, true), (true, false), (true, true)] {
            if a != b || x == y {
                self.clause(&[(a, !x), (b, !y), (signal, function.output(x, y))]);
            }
        }
    }
}

/// The signature of values, inverted if they are 1 in the first pattern.
fn hash(values: &[u64]) -> u64 {
    let turn = if values[0] & 1 == 1 { !0 } else { 0 };
    values.iter().fold(0, |hash, word| extended(hash, word ^ turn))
}

/// A hash with one more word; two different words give two different hashes.
fn extended(hash: u64, word: u64) -> u64 {
    (hash.rotate_left(23) ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parity(inputs: usize, backwards: bool) -> Network {
        let mut network = Network::new(inputs);
        let order: Vec<_> = if backwards { (0..inputs).rev().collect() } else { (0..inputs).collect() };
        let mut sum = network.input(order[0]);
        for &i in &order[1..] {
            let input = network.input(i);
            sum = network.add(Function::XOR, [sum, input]);
        }
        network.outputs.push(sum);
        network
    }

    #[test]
    fn equal_networks_are_proved_and_different_ones_distinguished() {
        assert!(equal(&parity(12, false), &parity(12, true)).is_ok());
        let mut other = parity(12, true);
        let last = other.gates.len() - 1;
        other.gates[last].function = Function::OR;
        let (output, inputs) = equal(&parity(12, false), &other).unwrap_err();
        assert_eq!((output, inputs.len()), (0, 12));
    }
}
