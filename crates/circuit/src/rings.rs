//! Rings of inverters: loops without another input and with an odd number of negations. They never settle.

use crate::{NetId, Netlist};
use nbc_base::model::Function;

pub fn rings(netlist: &Netlist) -> Vec<NetId> {
    let mut cells: Vec<NetId> = Vec::new();
    let mut seen = std::collections::BTreeSet::new();
    for start in netlist.ids() {
        let mut path = Vec::new();
        let mut at = Some(start);
        while let Some(cell) = at.filter(|cell| seen.insert(*cell)) {
            path.push(cell);
            at = driver(netlist, cell);
        }
        // A cell of this path again: a loop of cells that each have one input.
        let first = at.and_then(|cell| path.iter().position(|known| *known == cell));
        let ring = first.map_or(&[][..], |first| &path[first..]);
        let negations = ring.iter().filter(|&&cell| is_inverter(netlist, cell)).count();
        if negations % 2 == 1 {
            cells.extend(ring);
        }
    }
    cells.sort_unstable();
    cells
}

fn driver(netlist: &Netlist, id: NetId) -> Option<NetId> {
    match (netlist.cell(id), &netlist.pins(id)[..]) {
        (Some(cell), _) => {
            let operands = netlist.operands(id).into_iter().enumerate();
            let mut read = operands.filter(|&(input, _)| cell.function.depends_on(input)).map(|(_, net)| net);
            read.next().filter(|_| read.next().is_none())
        }
        (None, [pin]) => Some(*pin),
        _ => None,
    }
}

fn is_inverter(netlist: &Netlist, id: NetId) -> bool {
    netlist.cell(id).is_some_and(|cell| matches!(cell.function, Function::NOT | Function::NOT_B))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example::latch;

    fn ring(cells: usize) -> (Netlist, Vec<NetId>) {
        let mut netlist = Netlist::new("ring");
        let wire = netlist.add_wire("q", Some(false), None);
        let mut gates = vec![wire];
        for _ in 0..cells {
            gates.push(netlist.add_gate(Function::NOT, &[gates[gates.len() - 1]]));
        }
        netlist.drive(wire, 0, gates[cells]);
        let reader = netlist.add_gate(Function::NOT, &[gates[cells]]);
        netlist.add_output("r", reader);
        (netlist, gates)
    }

    #[test]
    fn an_odd_ring_is_found_without_what_reads_it() {
        let (netlist, gates) = ring(3);
        assert_eq!(rings(&netlist), gates);
    }

    #[test]
    fn an_even_ring_and_a_latch_settle() {
        assert_eq!(rings(&ring(2).0), []);
        assert_eq!(rings(&latch()), []);
    }
}
