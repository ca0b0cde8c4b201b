//! And-inverter graphs: every function is made of and-gates of two pins, which may be inverted.

use crate::interned::Interned;
use crate::network::{Gate, Network};
use nbc_base::model::Function;

/// 0 and 1 are the constants, `2 * n` is signal `n`, counted from 1 over sources and gates, `2 * n + 1` its inverse.
pub type AndLiteral = usize;

/// Gates without duplicates, each after what it reads.
#[derive(Clone, Debug)]
pub(crate) struct AndGraph {
    sources: usize,
    /// The pins of each gate, the larger first.
    pub(crate) ands: Interned<[AndLiteral; 2]>,
}

impl AndGraph {
    pub(crate) fn new(sources: usize) -> Self {
        Self { sources, ands: Interned::default() }
    }

    pub(crate) fn source(&self, at: usize) -> AndLiteral {
        assert!(at < self.sources, "the source exists");
        2 * (at + 1)
    }

    /// The number of signals, but for the constant.
    pub(crate) fn signals(&self) -> usize {
        self.sources + self.ands.items.len()
    }

    pub(crate) fn and(&mut self, a: AndLiteral, b: AndLiteral) -> AndLiteral {
        match [a.max(b), a.min(b)] {
            [_, 0] => 0,
            [a, 1] => a,
            [a, b] if a == b => a,
            [a, b] if a ^ b == 1 => 0,
            pins => 2 * (self.sources + 1 + self.ands.number(pins)),
        }
    }

    pub(crate) fn or(&mut self, a: AndLiteral, b: AndLiteral) -> AndLiteral {
        self.and(a ^ 1, b ^ 1) ^ 1
    }

    pub(crate) fn choice(&mut self, choice: AndLiteral, then: AndLiteral, otherwise: AndLiteral) -> AndLiteral {
        if then == otherwise {
            return then;
        }
        let [then, otherwise] = [self.and(choice, then), self.and(choice ^ 1, otherwise)];
        self.or(then, otherwise)
    }

    pub(crate) fn function(&mut self, function: Function, [a, b]: [AndLiteral; 2]) -> AndLiteral {
        if function.arity() < 2 {
            return match (function.depends_on(0), function.depends_on(1)) {
                (true, _) => a ^ usize::from(function == Function::NOT),
                (_, true) => b ^ usize::from(function == Function::NOT_B),
                _ => usize::from(function == Function::ONE),
            };
        }
        let minterms: Vec<_> = (0..4).filter(|i| function.bits() >> i & 1 == 1).collect();
        let literal = |i: usize| (a ^ usize::from(i >> 1 == 0), b ^ usize::from(i & 1 == 0));
        match minterms[..] {
            [i] => self.and(literal(i).0, literal(i).1),
            [i, j] => {
                let one = self.and(literal(i).0, literal(i).1);
                let two = self.and(literal(j).0, literal(j).1);
                self.or(one, two)
            }
            _ => self.function(function.inverted(), [a, b]) ^ 1,
        }
    }

    pub(crate) fn outputs(&mut self, network: &Network, inputs: &[AndLiteral]) -> Vec<AndLiteral> {
        let inputs: Vec<Option<AndLiteral>> = inputs.iter().copied().map(Some).collect();
        let outputs = self.known_outputs(network, &inputs);
        outputs.into_iter().map(|output| output.expect("all inputs are known")).collect()
    }

    /// The literals of the outputs of a network that do not depend on unknown inputs.
    pub(crate) fn known_outputs(
        &mut self,
        network: &Network,
        inputs: &[Option<AndLiteral>],
    ) -> Vec<Option<AndLiteral>> {
        assert_eq!(inputs.len(), network.inputs, "a literal for each input");
        let mut made = vec![Some(0), Some(1)];
        made.extend(inputs);
        for &Gate { function, pins } in &network.gates {
            let pin = |at: usize| if function.depends_on(at) { made[pins[at] as usize] } else { Some(0) };
            let known = pin(0).zip(pin(1));
            made.push(known.map(|(a, b)| self.function(function, [a, b])));
        }
        network.outputs.iter().map(|&output| made[output as usize]).collect()
    }
}
