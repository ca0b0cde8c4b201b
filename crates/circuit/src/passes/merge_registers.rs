//! Merges registers that always store the same bit, and the logic after them.

use std::collections::BTreeMap;

use crate::loops::Loops;
use crate::passes::share::{function, merge, ordered};
use crate::register::{Forcing, RegisterKind};
use crate::{NetId, Netlist};
use nbc_base::model::Function;

/// Registers are compared this often; in a netlist where that does not suffice, none is merged.
const MOST_SWEEPS: usize = 1000;

/// Two registers are equal if they are of one kind, start alike and read nets that are equal. The classes of equal nets
/// are found by assuming that registers of one kind that start alike are equal, and splitting the classes until that
/// holds (partition refinement). Loops of cells are never merged, because what they do may depend on delays.
pub fn merge_registers(netlist: &mut Netlist) {
    merged_registers(netlist).into_iter().for_each(|(id, first)| merge(netlist, id, first));
}

pub fn merged_registers(netlist: &Netlist) -> Vec<(NetId, NetId)> {
    if netlist.registers().count() < 2 {
        return Vec::new();
    }
    let Some(class_of) = classes(netlist) else { return Vec::new() };
    let mut first_of: BTreeMap<usize, NetId> = BTreeMap::new();
    let states = netlist.ids().filter(|&id| netlist.cell(id).is_some() || netlist.register(id).is_some());
    let firsts = states.map(|id| (id, *first_of.entry(class_of[&id]).or_insert(id)));
    firsts.filter(|(id, first)| id != first).collect()
}

type Shape = (Function, Vec<usize>);

fn classes(netlist: &Netlist) -> Option<BTreeMap<NetId, usize>> {
    let loops = Loops::memory(netlist);
    let mut beginnings: BTreeMap<(RegisterKind, Forcing, bool), usize> = BTreeMap::new();
    let mut of_register: BTreeMap<NetId, usize> = BTreeMap::new();
    for (id, register) in netlist.registers() {
        let fresh = beginnings.len();
        let beginning = (register.kind, register.forcing, register.starts_at());
        of_register.insert(id, *beginnings.entry(beginning).or_insert(fresh));
    }
    let mut count = beginnings.len();
    for _ in 0..MOST_SWEEPS {
        let of_net = spread(netlist, &loops, &of_register);
        let mut numbers = BTreeMap::new();
        for (&id, class) in &mut of_register {
            let pins: Vec<usize> = netlist.pins(id).iter().map(|pin| of_net[pin]).collect();
            let fresh = numbers.len();
            *class = *numbers.entry((*class, pins)).or_insert(fresh);
        }
        if numbers.len() == count {
            return Some(of_net);
        }
        count = numbers.len();
    }
    None
}

fn spread(netlist: &Netlist, loops: &Loops, of_register: &BTreeMap<NetId, usize>) -> BTreeMap<NetId, usize> {
    let mut of_net = of_register.clone();
    let mut fresh = of_register.len()..;
    let mut known: BTreeMap<Shape, usize> = BTreeMap::new();
    for &id in loops.order().iter().filter(|id| !of_register.contains_key(id)) {
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
    use crate::RegisterNode;

    /// The registers that are left of two chains that read the same input, with these starts.
    fn left(starts: [&[bool]; 2]) -> usize {
        let mut netlist = Netlist::new("two");
        let [a, clock] = ["a", "clk"].map(|name| netlist.add_input(name));
        for (starts, name) in starts.into_iter().zip(["x", "y"]) {
            let end = starts.iter().fold(a, |data, &start| {
                let (kind, forcing) = (RegisterKind::Rising, Forcing::Never);
                let register = RegisterNode { kind, forcing, start: Some(start), name: None, span: None };
                netlist.add_register(register, &[data, clock])
            });
            netlist.add_output(name, end);
        }
        merge_registers(&mut netlist);
        netlist.registers().count()
    }

    #[test]
    fn registers_that_start_alike_and_read_the_same_are_one() {
        assert_eq!(left([&[false, true], &[false, true]]), 2);
        // Only the first registers start alike; the second ones read the same bit.
        assert_eq!(left([&[false, true], &[false, false]]), 3);
        assert_eq!(left([&[true, true], &[false, true]]), 4);
        assert_eq!(left([&[false], &[false, false]]), 2);
    }
}
