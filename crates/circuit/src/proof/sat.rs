//! Comparison of two networks by SAT: gates that agree in simulation are proved equal from the inputs on and merged, so
//! that the outputs are easy in the end (SAT sweeping).

use std::collections::BTreeMap;

use batsat::SolverInterface;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rustsat::solvers::{Solve, SolveIncremental, SolverResult};
use rustsat::types::{Lit, TernaryVal};
use rustsat_batsat::BasicSolver;

use crate::network::{Gate, Network, Signal, word};
use crate::proof::method::Method;
use crate::proof::patterns::random_word;
use nbc_base::model::Function;

/// Words of 64 random patterns to start with.
const WORDS: usize = 32;

/// Proves two networks equal; fails with an output and inputs at which it differs.
pub fn equal(one: &Network, two: &Network) -> Result<Method, (usize, Vec<bool>)> {
    let mut comparison = Comparison::within(one, &[]);
    comparison.compare(two)?;
    Ok(Method::Sat { calls: comparison.sweep.calls })
}

/// The comparison of networks with one network. What is proved of a network helps to compare the next.
pub struct Comparison {
    sweep: SatSweep,
    outputs: Vec<(Signal, bool)>,
}

impl Comparison {
    /// A comparison with this network where all clauses hold: of each, an input has the given value.
    pub fn within(network: &Network, clauses: &[Vec<(usize, bool)>]) -> Self {
        let mut sweep = SatSweep::new(network.inputs);
        clauses.iter().for_each(|clause| sweep.assume(clause));
        let signals = sweep.add(network);
        Self { outputs: network.outputs.iter().map(|&output| signals[output as usize]).collect(), sweep }
    }

    /// Proves a network equal; fails with an output and inputs at which it differs.
    pub fn compare(&mut self, network: &Network) -> Result<(), (usize, Vec<bool>)> {
        let signals = self.sweep.add(network);
        for (output, (&a, &b)) in self.outputs.iter().zip(&network.outputs).enumerate() {
            if let Some(inputs) = self.sweep.difference(a, signals[b as usize]) {
                return Err((output, inputs));
            }
        }
        Ok(())
    }

    /// The work of the solver so far: its calls, and its propagations.
    pub fn work(&self) -> [u64; 2] {
        [self.sweep.calls as u64, self.sweep.solver.batsat_ref().num_propagations()]
    }

    /// The number of signals that were compared so far.
    pub fn signals(&self) -> usize {
        self.sweep.values.len()
    }
}

/// Signals of several networks over the same inputs, merged if they are proved equal or opposite.
pub struct SatSweep {
    solver: BasicSolver,
    /// The input words so far, `patterns[word][input]`.
    patterns: Vec<Vec<u64>>,
    inputs: usize,
    gates: Vec<Gate>,
    /// The values of each signal, `values[signal][word]`.
    values: Vec<Vec<u64>>,
    /// The signature of each signal's values, inverted if they are 1 in the first pattern.
    hashes: Vec<u64>,
    /// Signals by their hashes. If different values have the same hash, the solver finds a pattern that distinguishes
    /// them.
    classes: BTreeMap<u64, Signal>,
    /// The signal of each gate, by its function and pins as one number.
    known: BTreeMap<u128, (Signal, bool)>,
    /// The number of calls of the solver.
    pub calls: usize,
}

impl SatSweep {
    /// A solver with the inputs alone, without gates.
    pub fn new(inputs: usize) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(0x6e62_6370_726f_6f66);
        let patterns = (0..WORDS).map(|word| (0..inputs).map(|_| random_word(word, &mut random)).collect()).collect();
        let mut sweep = Self {
            solver: BasicSolver::default(),
            patterns,
            inputs,
            gates: Vec::new(),
            values: Vec::new(),
            hashes: Vec::new(),
            classes: BTreeMap::new(),
            known: BTreeMap::new(),
            calls: 0,
        };
        sweep.values = (0..2 + inputs).map(|signal| sweep.source_values(signal)).collect();
        sweep.hashes = sweep.values.iter().map(|values| hash(values)).collect();
        sweep.clause(&[sweep.literal(0, false)]);
        sweep.clause(&[sweep.literal(1, true)]);
        sweep.classify();
        sweep
    }

    fn source_values(&self, signal: usize) -> Vec<u64> {
        match signal {
            0 => vec![0; self.patterns.len()],
            1 => vec![!0; self.patterns.len()],
            _ => self.patterns.iter().map(|inputs| inputs[signal - 2]).collect(),
        }
    }

    fn literal(&self, signal: Signal, value: bool) -> Lit {
        Lit::new(signal, !value)
    }

    fn clause(&mut self, literals: &[Lit]) {
        self.solver.add_clause(literals.iter().copied().collect()).expect("clauses fit into memory");
    }

    /// Requires that one of these inputs has the given value. Signals that are merged later are equal only then.
    pub fn assume(&mut self, clause: &[(usize, bool)]) {
        let literals: Vec<Lit> =
            clause.iter().map(|&(input, value)| self.literal(input as Signal + 2, value)).collect();
        self.clause(&literals);
    }

    /// Adds a network's gates and returns the merged signal for each of its signals.
    pub fn add(&mut self, network: &Network) -> Vec<(Signal, bool)> {
        let mut made: Vec<(Signal, bool)> = (0..2 + network.inputs as Signal).map(|signal| (signal, false)).collect();
        for gate in &network.gates {
            let [a, b] = gate.pins.map(|pin| made[pin as usize]);
            let mut function = gate.function;
            for (pin, (_, inverted)) in [a, b].into_iter().enumerate() {
                function = if inverted { function.with_input_inverted(pin) } else { function };
            }
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

    /// Adds a gate, or finds the signal that equals it or its opposite.
    fn gate(&mut self, function: Function, pins: [Signal; 2]) -> (Signal, bool) {
        let signal = self.values.len() as Signal;
        let [a, b] = pins.map(|pin| &self.values[pin as usize]);
        let values: Vec<u64> = a.iter().zip(b).map(|(&a, &b)| word(function, a, b)).collect();
        self.hashes.push(hash(&values));
        self.values.push(values);
        self.gates.push(Gate { function, pins });
        self.define(signal, function, pins);
        loop {
            let hash = self.hashes[signal as usize];
            let Some(&class) = self.classes.get(&hash) else {
                self.classes.insert(hash, signal);
                return (signal, false);
            };
            let opposite = self.is_turned(signal) != self.is_turned(class);
            match self.difference((class, opposite), (signal, false)) {
                None => {
                    self.clause(&[self.literal(class, opposite), self.literal(signal, true)]);
                    self.clause(&[self.literal(class, !opposite), self.literal(signal, false)]);
                    // From here on the class represents the gate.
                    return (class, opposite);
                }
                Some(pattern) => self.learn(&pattern),
            }
        }
    }

    /// Whether a signal is 1 in the first pattern.
    fn is_turned(&self, signal: Signal) -> bool {
        self.values[signal as usize][0] & 1 == 1
    }

    /// The clauses of a gate: one for each pattern of its pins.
    fn define(&mut self, signal: Signal, function: Function, [a, b]: [Signal; 2]) {
        for (x, y) in [(false, false), (false, true), (true, false), (true, true)] {
            if a != b || x == y {
                let output = self.literal(signal, function.output(x, y));
                self.clause(&[self.literal(a, !x), self.literal(b, !y), output]);
            }
        }
    }

    /// Inputs at which two signals, each maybe inverted, differ.
    pub fn difference(&mut self, one: (Signal, bool), two: (Signal, bool)) -> Option<Vec<bool>> {
        if one == two {
            return None;
        }
        [false, true].into_iter().find_map(|value| self.pattern(&[(one, value), (two, !value)]))
    }

    /// Inputs at which signals, each maybe inverted, have these values.
    pub fn pattern(&mut self, wanted: &[((Signal, bool), bool)]) -> Option<Vec<bool>> {
        self.calls += 1;
        let literal = |&((signal, inverted), value): &((Signal, bool), bool)| self.literal(signal, value != inverted);
        let assumed: Vec<Lit> = wanted.iter().map(literal).collect();
        match self.solver.solve_assumps(&assumed) {
            Ok(SolverResult::Sat) => Some(self.inputs_found()),
            Ok(SolverResult::Unsat) => None,
            other => unreachable!("the solver runs without limits, and gave {other:?}"),
        }
    }

    fn inputs_found(&self) -> Vec<bool> {
        let value = |i: usize| self.solver.lit_val(self.literal(i as Signal + 2, true));
        (0..self.inputs).map(|i| matches!(value(i), Ok(TernaryVal::True))).collect()
    }

    /// Adds a word of patterns: the given one and those that differ from it in one input.
    fn learn(&mut self, pattern: &[bool]) {
        let words: Vec<u64> =
            pattern.iter().enumerate().map(|(i, &value)| if value { !0u64 } else { 0 } ^ 2 << (i % 63)).collect();
        self.patterns.push(words.clone());
        for signal in 0..self.values.len() {
            let value = match signal.checked_sub(2 + self.inputs) {
                None => self.source_values(signal)[self.patterns.len() - 1],
                Some(i) => {
                    let Gate { function, pins } = self.gates[i];
                    let [a, b] = pins.map(|pin| *self.values[pin as usize].last().expect("there are patterns"));
                    word(function, a, b)
                }
            };
            let turned = if self.is_turned(signal as Signal) { !value } else { value };
            self.hashes[signal] = extended(self.hashes[signal], turned);
            self.values[signal].push(value);
        }
        self.classify();
    }

    /// Sorts the signals that represent their classes by their values again.
    fn classify(&mut self) {
        let members: Vec<Signal> = if self.classes.is_empty() {
            (0..self.values.len() as Signal).filter(|&signal| signal != 1).collect()
        } else {
            self.classes.values().copied().collect()
        };
        self.classes.clear();
        for signal in members {
            let class = self.classes.entry(self.hashes[signal as usize]).or_insert(signal);
            *class = signal.min(*class);
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

    /// A chain of exclusive ors over the inputs, from one end or the other.
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
