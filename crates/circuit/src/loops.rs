//! Feedback loops: the strongly connected parts of a netlist, and the memory elements in them, which are state and stay
//! as written.

use std::collections::BTreeMap;

use crate::components::Components;
use crate::{NetId, Netlist};

/// The loops of a netlist, and an order of its nodes with drivers first, except on loops. Registers cut loops and are
/// first.
#[derive(Clone, Debug)]
pub struct Loops {
    cores: Vec<Vec<NetId>>,
    core_of: BTreeMap<NetId, usize>,
    order: Vec<NetId>,
}

impl Loops {
    pub fn of(netlist: &Netlist) -> Self {
        Self::inside(netlist, |id| netlist.register(id).is_none())
    }

    /// Also those through registers.
    pub(crate) fn through_registers(netlist: &Netlist) -> Self {
        Self::inside(netlist, |_| true)
    }

    fn inside(netlist: &Netlist, inside: impl Fn(NetId) -> bool) -> Self {
        let mut components = Components::new(netlist.graph()).from(netlist.ids(), &inside);
        components.reverse();
        let order = netlist.ids().filter(|&id| !inside(id)).collect();
        let mut loops = Self { cores: Vec::new(), core_of: BTreeMap::new(), order };
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

    /// Only the memory elements: of each loop, the cells that drive each other directly (a pair, or a cell that drives
    /// itself) and the cells that are still on a loop after these are cut. In [`Loops::order`] nothing waits for them.
    pub fn memory(netlist: &Netlist) -> Self {
        let mut loops = Self { cores: Vec::new(), core_of: BTreeMap::new(), order: Vec::new() };
        let mut rest = Components::new(netlist.graph());
        for core in Self::of(netlist).cores {
            let kept = memory_of(netlist, &core, &mut rest);
            loops.core_of.extend(kept.iter().map(|&id| (id, loops.cores.len())));
            loops.cores.push(kept);
        }
        let is_logic = |id| !loops.core_of.contains_key(&id) && netlist.register(id).is_none();
        let components = Components::new(netlist.graph()).from(netlist.ids(), is_logic);
        loops.order = netlist.registers().map(|(id, _)| id).chain(loops.cores.concat()).collect();
        loops.order.extend(components.into_iter().rev().flatten());
        loops
    }

    /// The nodes of each loop core, in order of their numbers; cores in topological order.
    pub fn cores(&self) -> &[Vec<NetId>] {
        &self.cores
    }

    pub(crate) fn core_of(&self, id: NetId) -> Option<usize> {
        self.core_of.get(&id).copied()
    }

    pub fn contains(&self, id: NetId) -> bool {
        self.core_of.contains_key(&id)
    }

    /// All nodes, drivers first; the nodes of one core are adjacent.
    pub fn order(&self) -> &[NetId] {
        &self.order
    }
}

/// `rest` must not contain a node of the core yet.
fn memory_of(netlist: &Netlist, core: &[NetId], rest: &mut Components) -> Vec<NetId> {
    let inside = |id: &NetId| core.binary_search(id).is_ok();
    let listeners = |id: NetId| netlist.fanout(id).into_iter().map(|(listener, _)| listener);
    let paired = |id: &NetId| listeners(*id).any(|listener| listener == *id || netlist.pins(*id).contains(&listener));
    let mut kept: Vec<NetId> = core.iter().copied().filter(paired).collect();
    let parts = rest.from(core.iter().copied(), |id| inside(&id) && kept.binary_search(&id).is_err());
    let still: Vec<NetId> = parts.into_iter().filter(|part| part.len() > 1).flatten().collect();
    kept.extend(still);
    kept.sort_unstable();
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example::latch;

    #[test]
    fn a_latch_has_one_core_of_two_cells() {
        let mut netlist = latch();
        crate::passes::dissolve_wires(&mut netlist).unwrap();
        let loops = Loops::of(&netlist);
        assert_eq!(loops.cores().len(), 1);
        assert_eq!(loops.cores()[0].len(), 2);
        assert_eq!(loops.order().len(), netlist.ids().count());
    }

    #[test]
    fn a_cell_that_drives_itself_is_a_loop() {
        let mut netlist = Netlist::new("hold");
        let a = netlist.add_input("a");
        let cell = netlist.add_gate(nbc_base::model::Function::OR, &[a, a]);
        netlist.drive(cell, 1, cell);
        netlist.add_output("q", cell);
        assert_eq!(Loops::of(&netlist).cores(), [vec![cell]]);
    }

    #[test]
    fn the_logic_between_registers_is_not_memory() {
        let mut netlist = Netlist::new("toggle");
        let clock = netlist.add_input("clk");
        let q = netlist.add_wire("q", Some(false), None);
        let next = netlist.add_gate(nbc_base::model::Function::NOT, &[q]);
        let state = crate::example::flip_flop(&mut netlist, "q", next, clock, false);
        netlist.drive(q, 0, state);
        netlist.add_output("q", q);
        assert!(Loops::of(&netlist).cores().is_empty(), "a register cuts a loop");
        let netlist = crate::as_nands(&netlist);
        assert_eq!(Loops::of(&netlist).cores().concat().len(), 9);
        assert_eq!(Loops::memory(&netlist).cores().concat().len(), 4);
        assert_eq!(Loops::memory(&netlist).order().len(), netlist.ids().count());
    }
}
