//! Feedback loops: the strongly connected parts of a netlist. What lies on a loop is state and stays as written.

use std::collections::BTreeMap;

use petgraph::algo::tarjan_scc;

use crate::circuit::{NetId, Netlist, Node};

/// The loops of a netlist, and an order of its nodes in which drivers come first wherever there is no loop.
#[derive(Clone, Debug)]
pub struct Loops {
    cores: Vec<Vec<NetId>>,
    core_of: BTreeMap<NetId, usize>,
    order: Vec<NetId>,
}

impl Loops {
    /// Finds the loops.
    pub fn of(netlist: &Netlist) -> Self {
        let mut components = tarjan_scc(netlist.graph());
        components.reverse();
        let mut loops = Self { cores: Vec::new(), core_of: BTreeMap::new(), order: Vec::new() };
        for mut component in components {
            component.sort_unstable();
            loops.order.extend(&component);
            let first = component[0];
            if component.len() > 1 || netlist.graph().contains_edge(first, first) {
                loops.core_of.extend(component.iter().map(|&id| (id, loops.cores.len())));
                loops.cores.push(component);
            }
        }
        loops
    }

    /// The nodes of each loop core, in order of their numbers; cores in topological order.
    pub fn cores(&self) -> &[Vec<NetId>] {
        &self.cores
    }

    /// The core that a node belongs to.
    pub fn core_of(&self, id: NetId) -> Option<usize> {
        self.core_of.get(&id).copied()
    }

    /// Whether a node lies on a loop.
    pub fn contains(&self, id: NetId) -> bool {
        self.core_of.contains_key(&id)
    }

    /// Every node, drivers first; the nodes of one core stand together.
    pub fn order(&self) -> &[NetId] {
        &self.order
    }

    /// The cells that drive a loop core from outside: a glitch on them can flip the state, so they stay as written too.
    pub fn guards(&self, netlist: &Netlist) -> Vec<NetId> {
        let mut guards: Vec<_> = self
            .core_of
            .keys()
            .flat_map(|&id| netlist.pins(id))
            .filter(|&pin| !self.contains(pin) && matches!(netlist.node(pin), Node::Cell(_)))
            .collect();
        guards.sort_unstable();
        guards.dedup();
        guards
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::circuit::example::latch;

    #[test]
    fn a_latch_has_one_core_of_two_cells_and_two_guards() {
        let mut netlist = latch();
        crate::circuit::passes::DissolveWires.run_on(&mut netlist).unwrap();
        let loops = Loops::of(&netlist);
        assert_eq!(loops.cores().len(), 1);
        assert_eq!(loops.cores()[0].len(), 2);
        assert_eq!(loops.guards(&netlist).len(), 2);
        assert_eq!(loops.order().len(), netlist.ids().count());
    }

    #[test]
    fn a_cell_that_feeds_itself_is_a_loop() {
        let mut netlist = Netlist::new("hold");
        let a = netlist.add_input("a");
        let cell = netlist.add_gate(crate::model::Function::OR, &[a, a]);
        netlist.drive(cell, 1, cell);
        netlist.add_output("q", cell);
        assert_eq!(Loops::of(&netlist).cores(), [vec![cell]]);
    }
}
