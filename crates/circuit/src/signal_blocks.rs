//! The blocks of cells that synthesis makes: each gets that of a source cell with the same values, or that of the cells
//! which read it.

use std::collections::BTreeMap;

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::network::{Network, Signal, View};
use crate::synth::CellNetwork;
use crate::{BlockId, Netlist};

const WORDS: usize = 8;

#[derive(Clone, Debug)]
pub(crate) struct SignalBlocks(pub Vec<Option<BlockId>>);

impl SignalBlocks {
    pub fn of(netlist: &Netlist, view: &View) -> Self {
        let mut blocks = vec![None; view.network.signals()];
        for (id, _) in netlist.cells() {
            if let Some(&signal) = view.signal.get(&id) {
                blocks[signal as usize].get_or_insert(netlist.block(id));
            }
        }
        Self(blocks)
    }

    pub fn renumbered(&self, made: &[Signal], signals: usize) -> Self {
        let mut blocks = vec![None; signals];
        for (block, &signal) in self.0.iter().zip(made) {
            if let Some(block) = block {
                blocks[signal as usize].get_or_insert(*block);
            }
        }
        Self(blocks)
    }

    /// The inputs of `made` are the `ports` of `source`.
    pub fn of_cells(&self, source: &Network, made: &CellNetwork, ports: &[usize]) -> Vec<BlockId> {
        let (known, wanted) = samples(source, made, ports);
        let mut by_values: BTreeMap<&[u64; WORDS], BlockId> = BTreeMap::new();
        let first = 2 + source.inputs;
        for (values, block) in known.iter().zip(&self.0).skip(first) {
            if let Some(block) = block {
                by_values.entry(values).or_insert(*block);
            }
        }
        let is_fixed = |values: &[u64; WORDS]| values.iter().all(|&word| word == 0);
        let find = |values: &[u64; WORDS]| by_values.get(values).copied().filter(|_| !is_fixed(values));
        let mut found: Vec<Option<BlockId>> = wanted.iter().map(find).collect();
        let mut readers: Vec<BTreeMap<BlockId, usize>> = vec![BTreeMap::new(); made.cells.len()];
        for (at, cell) in made.cells.iter().enumerate().rev() {
            let most = readers[at].iter().max_by_key(|&(&block, &count)| (count, std::cmp::Reverse(block)));
            let block = *found[at].get_or_insert(most.map_or(BlockId::TOP, |(&block, _)| block));
            for pin in cell.pins.iter().filter_map(|&pin| (pin as usize).checked_sub(2 + made.inputs)) {
                *readers[pin].entry(block).or_insert(0) += 1;
            }
        }
        found.into_iter().map(Option::unwrap_or_default).collect()
    }
}

/// The values of both networks for the same random inputs, the same for a signal and its inverse.
fn samples(source: &Network, made: &CellNetwork, ports: &[usize]) -> (Vec<[u64; WORDS]>, Vec<[u64; WORDS]>) {
    let mut plain = Network::new(made.inputs);
    let mut signals: Vec<Signal> = (0..(2 + made.inputs) as Signal).collect();
    for cell in &made.cells {
        let pins: Vec<Signal> = cell.pins.iter().map(|&pin| signals[pin as usize]).collect();
        let pins = if let [one] = pins[..] { vec![one; 2] } else { pins };
        signals.push(plain.add_function(cell.function, &pins));
    }
    let mut random = ChaCha8Rng::seed_from_u64(0x6e62_6362_6c6f_636b);
    let mut known = vec![[0; WORDS]; source.signals()];
    let mut wanted = vec![[0; WORDS]; made.cells.len()];
    for word in 0..WORDS {
        let inputs: Vec<u64> = (0..source.inputs).map(|_| random.next_u64()).collect();
        let taken: Vec<u64> = ports.iter().map(|&port| inputs[port]).collect();
        let (before, after) = (source.simulate(&inputs), plain.simulate(&taken));
        known.iter_mut().zip(&before).for_each(|(values, &value)| values[word] = value);
        let cells = signals[2 + made.inputs..].iter().map(|&signal| after[signal as usize]);
        wanted.iter_mut().zip(cells).for_each(|(values, value)| values[word] = value);
    }
    known.iter_mut().chain(&mut wanted).filter(|values| values[0] & 1 == 1).for_each(|values| {
        values.iter_mut().for_each(|word| *word = !*word);
    });
    (known, wanted)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::map;
    use crate::{Cell, CellLibrary, NetId};
    use nbc_base::model::Function;

    fn two_adders() -> Netlist {
        let mut netlist = Netlist::new("two");
        let [a, b, c, d] = ["a", "b", "c", "d"].map(|name| netlist.add_input(name));
        let [first, second] = ["one", "two"].map(|name| netlist.blocks_mut().add(name, "half_adder", BlockId::TOP));
        let mut half = |[a, b]: [NetId; 2], block| {
            let sum = netlist.add_gate(Function::XOR, &[a, b]);
            let carry = netlist.add_gate(Function::AND, &[a, b]);
            [sum, carry].iter().for_each(|&id| netlist.put_into(id, block));
            [sum, carry]
        };
        let [sum, carry] = half([a, b], first);
        let [last, other] = half([sum, c], second);
        let both = netlist.add_gate(Function::OR, &[carry, other]);
        let out = netlist.add_gate(Function::AND, &[both, d]);
        netlist.add_output("sum", last);
        netlist.add_output("carry", out);
        netlist
    }

    fn count(netlist: &Netlist) -> BTreeMap<String, usize> {
        let mut counts = BTreeMap::new();
        for (id, _) in netlist.cells() {
            *counts.entry(netlist.blocks().name(netlist.block(id)).to_owned()).or_insert(0) += 1;
        }
        counts
    }

    #[test]
    fn mapped_cells_are_in_the_blocks_of_their_sources() {
        let library = CellLibrary::uniform(["nand", "not"].map(|name| Function::parse(name).unwrap()));
        let mapped = map(&two_adders(), &library).unwrap();
        let counts = count(&mapped);
        assert!(counts["one"] >= 3 && counts["two"] >= 3 && counts[""] >= 1, "{counts:?}\n{mapped}");
        let same = map(&two_adders(), &CellLibrary::uniform([Function::XOR, Function::AND, Function::OR])).unwrap();
        assert_eq!(count(&same).into_values().collect::<Vec<_>>(), [2, 2, 2], "the same cells: 2 at the top\n{same}");
    }

    #[test]
    fn a_new_node_in_an_old_place_is_in_no_block() {
        let mut netlist = two_adders();
        let (id, _) = netlist.cells().next().unwrap();
        let block = netlist.block(id);
        assert_eq!(netlist.blocks().around(block), [block]);
        assert_eq!((netlist.blocks().name(block), netlist.blocks().circuit(block)), ("one", "half_adder"));
        netlist.remove(id);
        let new = netlist.add_loose_cell(Cell { function: Function::NOT, name: None, start: None, span: None });
        assert_eq!((new, netlist.block(new)), (id, BlockId::TOP));
    }
}
