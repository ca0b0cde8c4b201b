//! Cuts: sets of at most three signals that determine a signal, each with the function that they determine.

use crate::network::{Network, Signal};
use nbc_base::model::Function;

const MOST_CUTS: usize = 40;

/// The rows of a truth table of three inputs in which each input is 1.
const INPUTS: [u8; 3] = [0xf0, 0xcc, 0xaa];

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cut {
    /// The signals in ascending order; the first `count` are valid.
    leaves: [Signal; 3],
    count: usize,
    /// The signal as a function of them, as a truth table of three inputs.
    table: u8,
}

impl Cut {
    fn of(signal: Signal) -> Self {
        match signal {
            0 => Self { leaves: [0; 3], count: 0, table: 0 },
            1 => Self { leaves: [0; 3], count: 0, table: u8::MAX },
            _ => Self { leaves: [signal, 0, 0], count: 1, table: INPUTS[0] },
        }
    }

    pub fn leaves(&self) -> &[Signal] {
        &self.leaves[..self.count]
    }

    /// Constants and functions of one leaf are functions of two inputs.
    pub fn function(&self) -> Function {
        if self.count == 3 {
            return Function::three(self.table);
        }
        // Rows 0, 2, 4 and 6 are those in which the third input is 0.
        let bits = (0..4).map(|row| (self.table >> (2 * row) & 1) << row).sum();
        Function::new(bits)
    }

    fn joined(function: Function, [a, b]: [&Self; 2]) -> Option<Self> {
        let mut leaves = [0; 3];
        let mut count = 0;
        let (mut i, mut j) = (0, 0);
        while i < a.count || j < b.count {
            let next = match (a.leaves().get(i), b.leaves().get(j)) {
                (Some(&one), Some(&two)) => one.min(two),
                (one, two) => *one.or(two).expect("one of them is left"),
            };
            i += usize::from(a.leaves().get(i) == Some(&next));
            j += usize::from(b.leaves().get(j) == Some(&next));
            if count == leaves.len() {
                return None;
            }
            leaves[count] = next;
            count += 1;
        }
        let [x, y] = [a, b].map(|cut| cut.moved(&leaves[..count]));
        let pick = |row: u8, minterm: u8| if function.bits() >> row & 1 == 1 { minterm } else { 0 };
        let table = pick(0, !x & !y) | pick(1, !x & y) | pick(2, x & !y) | pick(3, x & y);
        Some(Self { leaves, count, table }.reduced())
    }

    /// The table in terms of these leaves, which contain its own.
    fn moved(&self, leaves: &[Signal]) -> u8 {
        let place = |leaf: &Signal| leaves.iter().position(|other| other == leaf).expect("the leaves contain these");
        let places: Vec<usize> = self.leaves().iter().map(place).collect();
        let row = |at: u8| {
            places.iter().enumerate().fold(0u8, |row, (own, &there)| row | (at >> (2 - there) & 1) << (2 - own))
        };
        (0..8).fold(0, |table, at| table | (self.table >> row(at) & 1) << at)
    }

    fn reduced(self) -> Self {
        let shift = |input: usize| 4 >> input;
        let depends = |input: usize| (self.table >> shift(input) ^ self.table) & !INPUTS[input] != 0;
        let kept: Vec<usize> = (0..self.count).filter(|&input| depends(input)).collect();
        if kept.len() == self.count {
            return self;
        }
        let mut leaves = [0; 3];
        kept.iter().enumerate().for_each(|(at, &input)| leaves[at] = self.leaves[input]);
        let row =
            |at: u8| kept.iter().enumerate().fold(0u8, |row, (own, &there)| row | (at >> (2 - own) & 1) << (2 - there));
        let table = (0..8).fold(0, |table, at| table | (self.table >> row(at) & 1) << at);
        Self { leaves, count: kept.len(), table }
    }

    fn is_within(&self, other: &Self) -> bool {
        self.leaves().iter().all(|leaf| other.leaves().contains(leaf))
    }
}

/// The cuts of each gate of a network but the gate itself, those of fewer leaves first.
pub fn cuts(network: &Network) -> Vec<Vec<Cut>> {
    let first = 2 + network.inputs;
    let mut made: Vec<Vec<Cut>> = Vec::with_capacity(network.gates.len());
    for gate in &network.gates {
        let [one, two] = gate.pins.map(|pin| {
            let below = (pin as usize).checked_sub(first).map_or(&[][..], |at| &made[at]);
            std::iter::once(Cut::of(pin)).chain(below.iter().copied()).collect::<Vec<Cut>>()
        });
        let mut found: Vec<Cut> = Vec::new();
        for cut in one.iter().flat_map(|a| two.iter().filter_map(|b| Cut::joined(gate.function, [a, b]))) {
            if found.iter().any(|known| known.is_within(&cut)) {
                continue;
            }
            found.retain(|known| !cut.is_within(known));
            found.push(cut);
        }
        found.sort_by_key(|cut| cut.count);
        found.truncate(MOST_CUTS);
        made.push(found);
    }
    made
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_majority_is_a_cut_of_its_gates() {
        let mut network = Network::new(3);
        let [a, b, c] = [0, 1, 2].map(|i| network.input(i));
        let both = network.add(Function::AND, [a, b]);
        let either = network.add(Function::OR, [b, a]);
        let carried = network.add(Function::AND, [c, either]);
        network.add(Function::OR, [carried, both]);
        let found = cuts(&network);
        let of_inputs = |gate: usize| found[gate].iter().find(|cut| cut.leaves() == [a, b, c]).map(Cut::function);
        assert_eq!(of_inputs(3), Some(Function::MAJ));
        assert_eq!(of_inputs(2), Some(Function::three(0xa8)));
        assert_eq!(found[0][0].function(), Function::AND);
        assert_eq!((found[1][0].leaves(), found[1][0].function()), (&[a, b][..], Function::OR));
    }

    #[test]
    fn leaves_without_effect_are_left_out() {
        let mut network = Network::new(2);
        let [a, b] = [0, 1].map(|i| network.input(i));
        let sum = network.add(Function::XOR, [a, b]);
        network.add(Function::XOR, [sum, a]);
        network.add(Function::AND, [sum, 0]);
        network.add(Function::XNOR, [b, 1]);
        let found = cuts(&network);
        assert!(found[1].iter().any(|cut| cut.leaves() == [b] && cut.function() == Function::BUF));
        assert_eq!((found[2][0].leaves().len(), found[2][0].function()), (0, Function::ZERO));
        assert_eq!((found[3][0].leaves(), found[3][0].function()), (&[b][..], Function::BUF));
    }
}
