//! Names for nets in files: each its own, with nothing in it that the format cannot read.

use std::collections::{BTreeMap, BTreeSet};

use crate::circuit::{NetId, Netlist, Node};

/// A name for every input, output and cell; `legal` turns a wish into what the format can read.
pub fn names(netlist: &Netlist, legal: impl Fn(&str) -> String) -> BTreeMap<NetId, String> {
    let mut taken = BTreeSet::new();
    let mut names = BTreeMap::new();
    let ports = netlist.inputs().iter().chain(netlist.outputs()).copied();
    let others = netlist.ids().filter(|&id| matches!(netlist.node(id), Node::Cell(_) | Node::Wire { .. }));
    for id in ports.chain(others) {
        // A cell that drives its namesake output needs another name only where the two are told apart.
        let wish = legal(&netlist.net_name(id));
        let numbered = (1..).map(|i| format!("{wish}_{i}"));
        let free = std::iter::once(wish.clone()).chain(numbered).find(|name| !taken.contains(name));
        let free = free.expect("there are more numbers than nets");
        taken.insert(free.clone());
        names.insert(id, free);
    }
    names
}

/// For each driver, the output that can stand for it: its first, if nothing else has the name.
pub fn stand_ins(netlist: &Netlist) -> BTreeMap<NetId, NetId> {
    let mut stand_ins = BTreeMap::new();
    for &output in netlist.outputs() {
        let driver = netlist.pins(output)[0];
        if matches!(netlist.node(driver), Node::Cell(_)) {
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
