//! Removes nodes that no output depends on.

use std::collections::BTreeSet;

use crate::passes::Pass;
use crate::{Netlist, NetlistError, Node};

#[derive(Clone, Copy, Debug)]
pub struct Sweep;

impl Pass for Sweep {
    fn name(&self) -> &'static str {
        "sweep"
    }

    fn about(&self) -> &'static str {
        "removes what no output depends on"
    }

    fn run(&self, netlist: &mut Netlist) -> Result<(), NetlistError> {
        let mut used: BTreeSet<_> = netlist.outputs().iter().copied().collect();
        let mut pending = netlist.outputs().to_vec();
        while let Some(id) = pending.pop() {
            pending.extend(netlist.pins(id).into_iter().filter(|&pin| used.insert(pin)));
        }
        let unused: Vec<_> = netlist
            .ids()
            .filter(|id| !used.contains(id) && matches!(netlist.node(*id), Node::Cell(_) | Node::Constant(_)))
            .collect();
        unused.into_iter().for_each(|id| netlist.remove(id));
        Ok(())
    }
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
        Sweep.run(&mut netlist).unwrap();
        assert_eq!(netlist.cells().count(), 1);
        assert_eq!(netlist.inputs().len(), 2);
    }
}
