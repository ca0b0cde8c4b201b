//! Merges cells that compute the same function of the same nets.

use std::collections::BTreeMap;

use crate::loops::Loops;
use crate::{Cell, NetId, Netlist, Node, RegisterNode};
use nbc_base::model::Function;

pub fn share(netlist: &mut Netlist) {
    let loops = Loops::memory(netlist);
    let mut known = BTreeMap::new();
    for &id in loops.order() {
        let Some(key) = key(netlist, id).filter(|_| !loops.contains(id)) else {
            continue;
        };
        let first = *known.entry(key).or_insert(id);
        if first != id {
            merge(netlist, id, first);
        }
    }
}

fn key(netlist: &Netlist, id: NetId) -> Option<(Function, Vec<NetId>)> {
    function(netlist, id).map(|function| ordered(function, netlist.pins(id)))
}

pub(super) fn function(netlist: &Netlist, id: NetId) -> Option<Function> {
    match netlist.node(id) {
        Node::Constant(value) => Some(if *value { Function::ONE } else { Function::ZERO }),
        Node::Cell(cell) => Some(cell.function),
        _ => None,
    }
}

pub(super) fn ordered<T: Ord>(function: Function, mut pins: Vec<T>) -> (Function, Vec<T>) {
    match pins[..] {
        [ref a, ref b] if b < a => {
            pins.reverse();
            (function.swapped(), pins)
        }
        _ => (function, pins),
    }
}

pub(super) fn merge(netlist: &mut Netlist, id: NetId, first: NetId) {
    netlist.move_listeners(id, first);
    let (name, span) = match netlist.node(id) {
        Node::Cell(Cell { name, span, .. }) | Node::Register(RegisterNode { name, span, .. }) => (name.clone(), *span),
        _ => (None, None),
    };
    if let Node::Cell(Cell { name: own, span: own_span, .. })
    | Node::Register(RegisterNode { name: own, span: own_span, .. }) = netlist.node_mut(first)
    {
        *own = own.take().or(name);
        *own_span = own_span.or(span);
    }
    netlist.remove(id);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_cells_merge_for_any_order_of_pins() {
        let mut netlist = Netlist::new("twice");
        let a = netlist.add_input("a");
        let b = netlist.add_input("b");
        let one = netlist.add_gate(Function::NAND, &[a, b]);
        let two = netlist.add_gate(Function::NAND, &[b, a]);
        let three = netlist.add_gate(Function::parse("a_and_notb").unwrap(), &[one, a]);
        let four = netlist.add_gate(Function::parse("nota_and_b").unwrap(), &[a, two]);
        let both = netlist.add_gate(Function::XOR, &[three, four]);
        netlist.add_output("q", both);
        share(&mut netlist);
        assert_eq!(netlist.cells().count(), 3);
        assert_eq!(netlist.pins(both), [three, three]);
    }
}
