//! Replaces inverters and buffers before clocks: a register with an inverted clock is one of the opposite kind.

use crate::storage::Inverters;
use crate::{NetId, Netlist, Node, RegisterNode};

pub fn turn_clocks(netlist: &mut Netlist) {
    let inverters = Inverters::of(netlist);
    let registers: Vec<NetId> = netlist.registers().map(|(id, _)| id).collect();
    for id in registers {
        let clock = netlist.pins(id)[usize::from(RegisterNode::CLOCK)];
        let (root, is_opposite) = inverters.root(clock);
        if let (Node::Register(register), true) = (netlist.node_mut(id), is_opposite) {
            register.kind = register.kind.opposite();
        }
        netlist.drive(id, RegisterNode::CLOCK, root);
    }
}
