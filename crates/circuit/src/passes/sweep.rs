//! Removes nodes that no output depends on.

use std::collections::BTreeSet;

use crate::{Netlist, Node};

pub fn sweep(netlist: &mut Netlist) {
    let mut used: BTreeSet<_> = netlist.outputs().iter().copied().collect();
    let mut pending = netlist.outputs().to_vec();
    while let Some(id) = pending.pop() {
        pending.extend(netlist.pins(id).into_iter().filter(|&pin| used.insert(pin)));
    }
    let unused: Vec<_> = netlist
        .ids()
        .filter(|id| {
            !used.contains(id) && matches!(netlist.node(*id), Node::Cell(_) | Node::Register(_) | Node::Constant(_))
        })
        .collect();
    unused.into_iter().for_each(|id| netlist.remove(id));
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_base::model::Function;

    #[test]
    fn unused_cells_are_removed_and_ports_stay() {
        let mut netlist = Netlist::new("waste");
        let a = netlist.add_input("a");
        netlist.add_input("b");
        let unused = netlist.add_gate(Function::OR, &[a, a]);
        netlist.drive(unused, 1, unused);
        let gate = netlist.add_gate(Function::NOT, &[a]);
        netlist.add_output("q", gate);
        sweep(&mut netlist);
        assert_eq!(netlist.cells().count(), 1);
        assert_eq!(netlist.inputs().len(), 2);
    }
}
