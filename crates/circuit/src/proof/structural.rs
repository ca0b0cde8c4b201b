//! Comparison of two networks gate by gate: every gate becomes a function of two earlier signals in one normal form, so
//! that the cells that replaced a gate become that gate again. This suffices for a network of any size that was only
//! covered.

use crate::cells::compose;
use crate::interned::Interned;
use crate::network::{Gate, Network};

/// Two networks may be equal although this is false.
pub fn equal(one: &Network, two: &Network) -> bool {
    let mut forms = Forms { inputs: one.inputs, forms: Interned::default() };
    forms.outputs(one) == forms.outputs(two)
}

type Literal = (u32, bool);

/// The functions that the two signals of a pair are of the pair, in the order of a function's bits.
const PAIR: [u8; 2] = [0b1100, 0b1010];

/// 0 is the constant 0, then the inputs, then functions of two earlier signals, without duplicates.
struct Forms {
    inputs: usize,
    /// The functions of two signals: the pair, the lower first, and a function that is 0 if both are 0.
    forms: Interned<([u32; 2], u8)>,
}

impl Forms {
    fn outputs(&mut self, network: &Network) -> Vec<Literal> {
        let mut made: Vec<Literal> = vec![(0, false), (0, true)];
        made.extend((1..=self.inputs as u32).map(|input| (input, false)));
        for gate in &network.gates {
            let literal = self.gate(gate, gate.pins.map(|pin| made[pin as usize]));
            made.push(literal);
        }
        network.outputs.iter().map(|&output| made[output as usize]).collect()
    }

    /// A function of the pair of one pin, if the other pin is a function of the same pair, else of its pins.
    fn gate(&mut self, gate: &Gate, [a, b]: [Literal; 2]) -> Literal {
        let pairs = [self.form(b.0), self.form(a.0)].into_iter().flatten().map(|(pair, _)| pair);
        let own = [a.0.min(b.0), a.0.max(b.0)];
        let of_pair = |pair| Some((pair, self.function(a, pair)?, self.function(b, pair)?));
        let (pair, x, y) = pairs.chain([own]).find_map(of_pair).expect("a gate is a function of its pins");
        let bits = compose(gate.function, x, y);
        let inverted = bits & 1 == 1;
        let bits = if inverted { bits ^ 0b1111 } else { bits };
        match PAIR.iter().position(|&signal| signal == bits) {
            Some(signal) => (pair[signal], inverted),
            None if bits == 0 => (0, inverted),
            None => ((1 + self.inputs + self.forms.number((pair, bits))) as u32, inverted),
        }
    }

    fn form(&self, signal: u32) -> Option<([u32; 2], u8)> {
        (signal as usize).checked_sub(1 + self.inputs).map(|at| self.forms.items[at])
    }

    fn function(&self, (signal, inverted): Literal, pair: [u32; 2]) -> Option<u8> {
        let bits = match pair.iter().position(|&one| one == signal) {
            _ if signal == 0 => 0,
            Some(at) => PAIR[at],
            None => self.form(signal).filter(|(own, _)| *own == pair)?.1,
        };
        Some(if inverted { bits ^ 0b1111 } else { bits })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example::library;
    use crate::synth::prices::Prices;
    use crate::synth::reduce::cover;
    use nbc_base::model::Function;

    fn chain() -> Network {
        let mut network = Network::new(3);
        let mut last = network.input(0);
        for (i, function) in Function::all().chain(Function::all()).enumerate() {
            let input = network.input(i % 3);
            let gate = network.add(function, [last, input]);
            last = network.add(Function::XOR, [gate, last]);
        }
        network.outputs = (0..network.signals() as u32).collect();
        network
    }

    #[test]
    fn covered_gates_become_the_same_gates_again() {
        for cells in ["nand", "nor not", "xor and", "a_or_notb", "nand and or xor not"] {
            let covered = cover(&chain(), &Prices::of(&library(cells)), &[]).unwrap();
            assert!(equal(&chain(), &covered), "{cells}");
        }
    }

    #[test]
    fn a_different_gate_or_output_is_found() {
        let mut other = chain();
        other.gates[20].function = other.gates[20].function.inverted();
        assert!(!equal(&chain(), &other));
        let mut other = chain();
        other.outputs.swap(0, 1);
        assert!(!equal(&chain(), &other));
    }
}
