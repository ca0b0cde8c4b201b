//! Names for nets in files: each its own, with nothing in it that the format cannot read.

use std::collections::{BTreeMap, BTreeSet};

use crate::circuit::{NetId, Netlist, Node};

/// A name for every input, output and cell; `legal` turns a wish into what the format can read.
///
/// Ports choose first, then the values and next values of `registers`, which are the last inputs and outputs, then cells.
pub fn names(netlist: &Netlist, registers: usize, legal: impl Fn(&str) -> String) -> BTreeMap<NetId, String> {
    let mut taken = BTreeSet::new();
    let mut names = BTreeMap::new();
    let (inputs, states) = netlist.inputs().split_at(netlist.inputs().len() - registers);
    let (outputs, nexts) = netlist.outputs().split_at(netlist.outputs().len() - registers);
    let ports = [inputs, outputs, states, nexts].concat().into_iter();
    let others = netlist.ids().filter(|&id| matches!(netlist.node(id), Node::Cell(_) | Node::Wire { .. }));
    for id in ports.chain(others) {
        // A net that drives its namesake output needs another name only where the two are told apart.
        let wish = legal(&netlist.net_name(id));
        let numbered = (1..).map(|i| format!("{wish}_{i}"));
        let free = std::iter::once(wish.clone()).chain(numbered).find(|name| !taken.contains(name));
        let free = free.expect("there are more numbers than nets");
        taken.insert(free.clone());
        names.insert(id, free);
    }
    names
}

/// For each cell or register's value that drives outputs, the output that can stand for it: the first.
pub fn stand_ins(netlist: &Netlist, registers: usize) -> BTreeMap<NetId, NetId> {
    let mut stand_ins = BTreeMap::new();
    let states = &netlist.inputs()[netlist.inputs().len() - registers..];
    for &output in netlist.outputs() {
        let driver = netlist.pins(output)[0];
        if matches!(netlist.node(driver), Node::Cell(_)) || states.contains(&driver) {
            stand_ins.entry(driver).or_insert(output);
        }
    }
    stand_ins
}

/// The cells, drivers first where there is no loop.
pub fn cells_in_order(netlist: &Netlist) -> Vec<NetId> {
    let loops = crate::circuit::Loops::of(netlist);
    loops.order().iter().copied().filter(|&id| matches!(netlist.node(id), Node::Cell(_))).collect()
}
