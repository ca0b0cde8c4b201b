//! Chains as trees: a chain of gates, each of which changes what the one before it computes, becomes a tree.
//!
//! A chain whose gates are ANDs and ORs computes `generate or (propagate and x)` from its first signal `x`, and so does
//! each part of it. The parts of a chain are composed as in the carry of an adder (Sklansky 1960), so its depth grows
//! as the logarithm of its length. Parts of many chains that read the same signals are made once, as in a priority
//! encoder.

use std::collections::BTreeMap;

use crate::network::{Network, Signal};
use nbc_base::model::Function;

const FEWEST: usize = 8;
/// The most gates of a chain, and of all chains together.
const MOST: usize = 4_096;
const MOST_OF_ALL: usize = 400_000;

#[derive(Clone, Copy, Debug)]
struct Link {
    is_or: bool,
    side: Signal,
}

/// A network of the same function with trees in the place of chains; `None` if it has none, or too many.
pub fn balanced(network: &Network) -> Option<Network> {
    let levels = levels(network);
    let mut tree = Tree { network: Network::new(network.inputs), known: BTreeMap::new() };
    let first = 2 + network.inputs;
    let mut made: Vec<Signal> = (0..(first + network.gates.len()) as Signal).collect();
    for (at, chain) in chains(network, &levels)? {
        made[at as usize] = match chain {
            Some(chain) => chain.build(network, &made, &mut tree),
            None => {
                let gate = network.gate(at).expect("only gates are made");
                tree.gate(gate.function, gate.pins.map(|pin| made[pin as usize]))
            }
        };
    }
    tree.network.outputs = network.outputs.iter().map(|&output| made[output as usize]).collect();
    Some(tree.network.swept())
}

/// The signals in order, each with the long chain that ends in it. `None` if there are no chains, or too many.
fn chains(network: &Network, levels: &[u32]) -> Option<Vec<(Signal, Option<Chain>)>> {
    let mut is_needed = vec![false; network.signals()];
    network.outputs.iter().for_each(|&output| is_needed[output as usize] = true);
    let mut total = 0;
    let mut all = Vec::new();
    for at in (2 + network.inputs..network.signals()).rev() {
        if !is_needed[at] {
            continue;
        }
        let chain = Chain::to(network, levels, at as Signal);
        total += chain.gates.len();
        if total > MOST_OF_ALL {
            return None;
        }
        let is_long = chain.gates.len() >= FEWEST;
        if is_long {
            chain.read(network).for_each(|signal| is_needed[signal as usize] = true);
        } else {
            network.gates[at - 2 - network.inputs].pins.iter().for_each(|&pin| is_needed[pin as usize] = true);
        }
        all.push((at as Signal, is_long.then_some(chain)));
    }
    all.reverse();
    all.iter().any(|(_, chain)| chain.is_some()).then_some(all)
}

pub fn levels(network: &Network) -> Vec<u32> {
    let mut levels = vec![0; 2 + network.inputs];
    for gate in &network.gates {
        let level = |pin: usize| levels[gate.pins[pin] as usize] * u32::from(gate.function.depends_on(pin));
        levels.push(1 + level(0).max(level(1)));
    }
    levels
}

/// The gates from a signal back to where their latest pins are no AND or OR, the first one last.
struct Chain {
    gates: Vec<(Signal, usize)>,
}

impl Chain {
    fn to(network: &Network, levels: &[u32], end: Signal) -> Self {
        let mut gates = Vec::new();
        let mut at = end;
        while let Some(gate) = network.gate(at).filter(|_| gates.len() < MOST) {
            let level = |pin: usize| levels[gate.pins[pin] as usize];
            let pin = match [0, 1].map(|pin| gate.function.depends_on(pin)) {
                [true, true] if is_exclusive(gate.function) || gate.pins[0] == gate.pins[1] => break,
                [true, true] => usize::from(level(1) > level(0)),
                [true, false] => 0,
                [false, true] => 1,
                [false, false] => break,
            };
            gates.push((at, pin));
            at = gate.pins[pin];
        }
        Self { gates }
    }

    fn read<'n>(&'n self, network: &'n Network) -> impl Iterator<Item = Signal> + 'n {
        let pins = |signal: Signal| network.gate(signal).expect("a chain has gates only").pins;
        let first = self.gates.last().map(|&(signal, pin)| pins(signal)[pin]);
        self.gates.iter().map(move |&(signal, pin)| pins(signal)[1 - pin]).chain(first)
    }

    fn build(&self, network: &Network, made: &[Signal], tree: &mut Tree) -> Signal {
        let mut links = Vec::with_capacity(self.gates.len());
        let mut is_inverted = false;
        for &(signal, pin) in self.gates.iter().rev() {
            let gate = network.gate(signal).expect("a chain has gates only");
            let function = if is_inverted { gate.function.with_input_inverted(pin) } else { gate.function };
            // The values for the other signal 0 and 1, each with the chain 0 and 1.
            let value =
                |side: bool, x: bool| if pin == 0 { function.output(x, side) } else { function.output(side, x) };
            if !function.depends_on(1 - pin) {
                is_inverted = value(false, false);
                continue;
            }
            // Of one value of the other signal, the result is constant, and of the other one it is the chain.
            let open = value(true, false) != value(true, true);
            let forced = value(!open, false);
            is_inverted = value(open, false);
            let is_or = forced != is_inverted;
            let other = made[gate.pins[1 - pin] as usize];
            let side = if open == is_or { tree.not(other) } else { other };
            // `s or (not s and x)` is `s or x`, and `s and (not s or x)` is `s and x`.
            if links.last().is_some_and(|last: &Link| last.is_or != is_or && tree.are_opposite(last.side, side)) {
                links.pop();
            }
            links.push(Link { is_or, side });
        }
        let (start, pin) = self.gates[self.gates.len() - 1];
        let x = made[network.gate(start).expect("a chain has gates only").pins[pin] as usize];
        let result = if links.is_empty() { x } else { tree.all(&links, x) };
        if is_inverted { tree.not(result) } else { result }
    }
}

fn is_exclusive(function: Function) -> bool {
    matches!(function, Function::XOR) || function == Function::XOR.inverted()
}

struct Tree {
    network: Network,
    known: BTreeMap<(u8, [Signal; 2]), Signal>,
}

impl Tree {
    fn not(&mut self, signal: Signal) -> Signal {
        match signal {
            0 | 1 => 1 - signal,
            _ => self.gate(Function::NOT, [signal, signal]),
        }
    }

    fn are_opposite(&self, one: Signal, two: Signal) -> bool {
        let inverter = |signal: Signal| self.known.get(&(Function::NOT.bits(), [signal; 2])).copied();
        inverter(one) == Some(two) || inverter(two) == Some(one)
    }

    fn gate(&mut self, function: Function, pins: [Signal; 2]) -> Signal {
        match (function, pins) {
            (Function::AND, [0, _] | [_, 0]) => return 0,
            (Function::OR, [1, _] | [_, 1]) => return 1,
            (Function::AND, [1, other] | [other, 1]) | (Function::OR, [0, other] | [other, 0]) => return other,
            _ => {}
        }
        let (function, pins) = match [0, 1].map(|pin| function.depends_on(pin)) {
            [true, false] => (function, [pins[0]; 2]),
            [false, true] => (function.swapped(), [pins[1]; 2]),
            _ => (function, pins),
        };
        let network = &mut self.network;
        *self.known.entry((function.bits(), pins)).or_insert_with(|| network.add(function, pins))
    }

    fn all(&mut self, links: &[Link], x: Signal) -> Signal {
        let generated = self.generate(links);
        let passed = self.pass(links, x);
        self.gate(Function::OR, [generated, passed])
    }

    /// Where the links make the chain 1 because a signal is 1; where they make it 1 anyway, it does not matter.
    fn pass(&mut self, links: &[Link], x: Signal) -> Signal {
        if links.iter().all(|link| link.is_or) {
            return x;
        }
        let propagated = self.propagate(links);
        self.gate(Function::AND, [propagated, x])
    }

    fn generate(&mut self, links: &[Link]) -> Signal {
        let Some((inner, outer)) = halves(links) else {
            return if links[0].is_or { links[0].side } else { 0 };
        };
        let below = self.generate(inner);
        let above = self.generate(outer);
        if below == 0 {
            return above;
        }
        let passed = self.pass(outer, below);
        self.gate(Function::OR, [above, passed])
    }

    fn propagate(&mut self, links: &[Link]) -> Signal {
        let Some((inner, outer)) = halves(links) else {
            return if links[0].is_or { self.not(links[0].side) } else { links[0].side };
        };
        let parts = [self.propagate(inner), self.propagate(outer)];
        self.gate(Function::AND, parts)
    }
}

/// The parts of a chain: the first one has as many links as a power of two, so that chains that begin alike share it.
fn halves(links: &[Link]) -> Option<(&[Link], &[Link])> {
    (links.len() > 1).then(|| links.split_at(links.len().next_power_of_two() / 2))
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use crate::proof::equal;
    use crate::synth::candidates::below;

    /// A chain for each bit of the number of the first input that is 1, from the last input on.
    fn encoder(inputs: usize, bits: usize) -> Network {
        let mut network = Network::new(inputs);
        for bit in 0..bits {
            let mut chain = 0;
            for input in (0..inputs).rev() {
                let signal = network.input(input);
                chain = network.add(Function::AND.with_input_inverted(0), [signal, chain]);
                if input >> bit & 1 == 1 {
                    chain = network.add(Function::OR, [signal, chain]);
                }
            }
            network.outputs.push(chain);
        }
        network
    }

    #[test]
    fn a_priority_encoder_is_a_tree_of_fewer_gates() {
        let network = encoder(64, 6);
        let tree = balanced(&network).unwrap();
        assert!(equal(&network, &tree).is_ok());
        let depth = |network: &Network| levels(network).into_iter().max().unwrap();
        assert!(depth(&network) > 90 && depth(&tree) <= 14, "{} {}", depth(&network), depth(&tree));
        assert!(tree.gates.len() < 3 * network.gates.len() / 4, "{} {}", network.gates.len(), tree.gates.len());
    }

    #[test]
    fn any_chains_keep_their_function() {
        let mut random = ChaCha8Rng::seed_from_u64(3);
        for _ in 0..200 {
            let inputs = 9;
            let mut network = Network::new(inputs);
            let mut chain = 2;
            for _ in 0..30 {
                let side = below(&mut random, network.signals()) as Signal;
                let pins = if below(&mut random, 2) == 0 { [chain, side] } else { [side, chain] };
                chain = network.add(Function::new(below(&mut random, 16) as u8), pins);
            }
            network.outputs = (2 + inputs as Signal..network.signals() as Signal).collect();
            if let Some(tree) = balanced(&network) {
                assert!(equal(&network, &tree).is_ok(), "{network:?}");
            }
        }
    }

    #[test]
    fn a_network_without_chains_stays() {
        let mut network = Network::new(2);
        let both = network.add(Function::AND, [2, 3]);
        network.outputs.push(both);
        assert_eq!(balanced(&network), None);
    }
}
