//! Merges latches and flip-flops that always store the same bit, and the logic after them.

use std::collections::BTreeMap;

use crate::cells::CellKind;
use crate::loops::Loops;
use crate::passes::share::{function, merge, ordered};
use crate::{NetId, Netlist, Storage};
use nbc_base::model::Function;

/// Registers are compared this often; in a netlist where that does not suffice, none is merged.
const MOST_SWEEPS: usize = 1000;

/// Two latches are equal if they start alike and their cells are wired alike to nets that are equal. The classes of
/// equal nets are found by assuming that latches that start alike are equal, and splitting the classes until that holds
/// (partition refinement). Other memory is never merged, because what it does may depend on the delays of its cells.
pub fn merge_registers(netlist: &mut Netlist) {
    merged_registers(netlist).into_iter().for_each(|(id, first)| merge(netlist, id, first));
}

pub fn merged_registers(netlist: &Netlist) -> Vec<(NetId, NetId)> {
    const KIND: CellKind = CellKind::uniform(1, 1.0);
    let storage = Storage::of(netlist, |_| &KIND);
    if storage.latches.len() < 2 {
        return Vec::new();
    }
    let Some(classes) = Classes::of(netlist, &storage) else { return Vec::new() };
    let mut first_of: BTreeMap<usize, NetId> = BTreeMap::new();
    let cells = netlist.ids().filter(|&id| netlist.cell(id).is_some());
    let firsts = cells.map(|id| (id, *first_of.entry(classes.of_net[&id]).or_insert(id)));
    firsts.filter(|(id, first)| id != first).collect()
}

struct Classes {
    of_net: BTreeMap<NetId, usize>,
}

type Beginning = (Function, Option<bool>, usize);

type Shape = (Function, Vec<usize>);

impl Classes {
    fn of(netlist: &Netlist, storage: &Storage) -> Option<Self> {
        let loops = Loops::memory(netlist);
        let mut beginnings: BTreeMap<Beginning, usize> = BTreeMap::new();
        let mut of_memory: BTreeMap<NetId, usize> = BTreeMap::new();
        for latch in &storage.latches {
            for (place, &id) in latch.cells.iter().enumerate() {
                let Some(cell) = netlist.cell(id) else { continue };
                let fresh = beginnings.len();
                of_memory.insert(id, *beginnings.entry((cell.function, cell.start, place)).or_insert(fresh));
            }
        }
        let mut count = beginnings.len();
        for _ in 0..MOST_SWEEPS {
            let of_net = spread(netlist, &loops, &of_memory);
            let mut numbers = BTreeMap::new();
            for (&id, class) in &mut of_memory {
                let shape = shape(netlist, id, &of_net);
                let fresh = numbers.len();
                *class = *numbers.entry((*class, shape)).or_insert(fresh);
            }
            if numbers.len() == count {
                return Some(Self { of_net });
            }
            count = numbers.len();
        }
        None
    }
}

fn spread(netlist: &Netlist, loops: &Loops, of_memory: &BTreeMap<NetId, usize>) -> BTreeMap<NetId, usize> {
    let mut of_net = of_memory.clone();
    let mut fresh = of_memory.len()..;
    let mut known: BTreeMap<Shape, usize> = BTreeMap::new();
    for &id in loops.order().iter().filter(|id| !of_memory.contains_key(id)) {
        let mut next = || fresh.next().expect("numbers do not end");
        let class = match shape(netlist, id, &of_net).filter(|_| !loops.contains(id)) {
            Some(shape) => *known.entry(shape).or_insert_with(next),
            None => next(),
        };
        of_net.insert(id, class);
    }
    of_net
}

fn shape(netlist: &Netlist, id: NetId, of_net: &BTreeMap<NetId, usize>) -> Option<Shape> {
    let function = function(netlist, id)?;
    let pins = netlist.pins(id).iter().map(|pin| of_net.get(pin).copied()).collect::<Option<_>>()?;
    Some(ordered(function, pins))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Cell, Logic};

    fn shift(netlist: &mut Netlist, data: NetId, clock: NetId, starts: &[bool]) -> NetId {
        let opposite = netlist.add_gate(Function::NOT, &[clock]);
        starts.iter().fold(data, |data, &start| {
            let first = latch(netlist, data, opposite, start);
            latch(netlist, first, clock, start)
        })
    }

    fn latch(netlist: &mut Netlist, data: NetId, enable: NetId, start: bool) -> NetId {
        let set = netlist.add_gate(Function::NAND, &[data, enable]);
        let reset = netlist.add_gate(Function::NAND, &[set, enable]);
        let cell = |start| Cell { function: Function::NAND, name: None, start: Some(start), span: None };
        let q = netlist.add_cell(cell(start), &[set, set]);
        let nq = netlist.add_cell(cell(!start), &[reset, q]);
        netlist.drive(q, 1, nq);
        q
    }

    fn left(starts: [&[bool]; 2]) -> usize {
        let mut netlist = Netlist::new("two");
        let [a, clock] = ["a", "clk"].map(|name| netlist.add_input(name));
        let ends = starts.map(|starts| shift(&mut netlist, a, clock, starts));
        netlist.add_output("x", ends[0]);
        netlist.add_output("y", ends[1]);
        let before = netlist.clone();
        merge_registers(&mut netlist);
        let mut both = [Logic::new(&before), Logic::new(&netlist)];
        for row in 0..32 {
            let [one, two] = both.each_mut().map(|logic| logic.settle(&[row / 4 % 2 == 1, row % 2 == 1]).unwrap());
            assert_eq!(one, two);
        }
        netlist.cells().count()
    }

    #[test]
    fn registers_that_start_alike_and_read_the_same_are_one() {
        assert_eq!(left([&[false, true], &[false, true]]), 1 + 2 * 8);
        // Only the first registers start alike; the second ones read the same bit by the same guards.
        assert_eq!(left([&[false, true], &[false, false]]), 1 + 3 * 8 - 2);
        assert_eq!(left([&[false, true], &[true, true]]), 1 + 4 * 8 - 2);
    }

    #[test]
    fn a_ring_of_inverters_stays() {
        let mut netlist = Netlist::new("ring");
        let cell = || Cell { function: Function::NOT, name: None, start: Some(false), span: None };
        let a = netlist.add_input("a");
        let [one, two, three] = [(); 3].map(|()| netlist.add_cell(cell(), &[a]));
        [(one, three), (two, one), (three, two)].into_iter().for_each(|(to, from)| netlist.drive(to, 0, from));
        netlist.add_output("q", one);
        merge_registers(&mut netlist);
        assert_eq!(netlist.cells().count(), 3);
    }
}
