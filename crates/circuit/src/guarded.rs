//! Guarded memory: the cells that stay as written in every pass and in mapping, because their transitions between two
//! states decide what is stored (docs/timing.md, "What stays as written").

use std::collections::{BTreeMap, BTreeSet};

use crate::known::{TernaryBit, answer};
use crate::loops::Loops;
use crate::{NetId, Netlist, Node, RegisterNode};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    Memory,
    /// It drives a memory element: a glitch on it can flip the state, even if some of its pins are constant.
    Guard,
    /// It computes an enable or a clock, which closes several guards at once. The order of two enables decides whether
    /// a register stores one bit or lets two pass, so they stay derived from each other as written.
    Control,
}

#[derive(Clone, Debug)]
pub struct Guarded {
    loops: Loops,
    roles: BTreeMap<NetId, Role>,
}

impl Guarded {
    pub fn of(netlist: &Netlist) -> Self {
        let loops = Loops::memory(netlist);
        let is_cell = |id: &NetId| netlist.cell(*id).is_some();
        let mut guarded = Self { loops, roles: BTreeMap::new() };
        let cores = guarded.loops.cores().to_vec();
        guarded.roles.extend(cores.iter().flatten().filter(|id| is_cell(id)).map(|&id| (id, Role::Memory)));
        let mut controls = Vec::new();
        for element in cores.iter().flat_map(|core| elements(netlist, core)) {
            let outside = element.iter().flat_map(|&id| netlist.pins(id)).filter(|pin| !guarded.loops.contains(*pin));
            let guards: BTreeSet<NetId> = outside.filter(is_cell).collect();
            controls.extend(controls_of(netlist, &element, &guards));
            guarded.roles.extend(guards.into_iter().map(|id| (id, Role::Guard)));
        }
        controls.extend(netlist.registers().map(|(id, _)| netlist.pins(id)[usize::from(RegisterNode::CLOCK)]));
        guarded.add_control_cone(netlist, controls);
        guarded
    }

    pub fn role(&self, id: NetId) -> Option<Role> {
        self.roles.get(&id).copied()
    }

    pub fn replace(&mut self, old: NetId, new: NetId) {
        if let Some(role) = self.roles.remove(&old) {
            self.roles.insert(new, role);
        }
    }

    pub fn memory(&self) -> &Loops {
        &self.loops
    }

    pub fn cells(&self) -> impl Iterator<Item = NetId> + '_ {
        self.loops.order().iter().copied().filter(|id| self.roles.contains_key(id))
    }

    fn add_control_cone(&mut self, netlist: &Netlist, mut pending: Vec<NetId>) {
        while let Some(id) = pending.pop() {
            if netlist.cell(id).is_some() && !self.roles.contains_key(&id) {
                self.roles.insert(id, Role::Control);
                pending.extend(netlist.pins(id));
            }
        }
    }
}

/// The connected parts of a loop's memory: a state machine has one for each of its registers' latches.
pub(crate) fn elements(netlist: &Netlist, core: &[NetId]) -> Vec<Vec<NetId>> {
    let mut rest: BTreeSet<NetId> = core.iter().copied().collect();
    let mut elements = Vec::new();
    while let Some(first) = rest.pop_first() {
        let mut element = vec![first];
        let mut at = 0;
        while at < element.len() {
            let own = element[at];
            let near = netlist.pins(own).into_iter().filter(|&pin| netlist.pins(pin).contains(&own));
            element.extend(near.filter(|pin| rest.remove(pin)));
            at += 1;
        }
        elements.push(element);
    }
    elements
}

/// One value of such a net fixes all guards and cells of the element that read it, which are at least two.
fn controls_of(netlist: &Netlist, element: &[NetId], guards: &BTreeSet<NetId>) -> Vec<NetId> {
    let mut fixing: BTreeMap<NetId, (usize, [bool; 2])> = BTreeMap::new();
    for &listener in element.iter().chain(guards) {
        let mut pins = netlist.pins(listener);
        pins.dedup();
        for &net in pins.iter().filter(|pin| !element.contains(pin) && !guards.contains(pin)) {
            let (count, fixed) = fixing.entry(net).or_insert((0, [true; 2]));
            *count += 1;
            fixed
                .iter_mut()
                .zip([false, true])
                .for_each(|(fixed, value)| *fixed &= fixes(netlist, listener, net, value));
        }
    }
    fixing.into_iter().filter(|(_, (count, fixed))| *count > 1 && fixed.contains(&true)).map(|(net, _)| net).collect()
}

fn fixes(netlist: &Netlist, id: NetId, net: NetId, value: bool) -> bool {
    let Node::Cell(cell) = netlist.node(id) else { return false };
    let function = cell.function;
    let bits: Vec<TernaryBit> = netlist.operands(id).iter().map(|&pin| (pin == net).then_some(value)).collect();
    answer(function, &bits).is_some()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::as_nands;
    use crate::example::{flip_flop, latch};
    use crate::passes::dissolve_wires;
    use nbc_base::model::Function;

    fn check(netlist: &Netlist, memory: usize, guards: usize, controls: usize) {
        let guarded = Guarded::of(netlist);
        let count = |role| netlist.ids().filter(|&id| guarded.role(id) == Some(role)).count();
        assert_eq!([Role::Memory, Role::Guard, Role::Control].map(count), [memory, guards, controls], "{netlist}");
        assert_eq!(guarded.cells().count(), memory + guards + controls);
    }

    #[test]
    fn a_latch_is_two_cells_and_two_guards_and_its_data_is_free() {
        let mut netlist = latch();
        dissolve_wires(&mut netlist).unwrap();
        check(&netlist, 2, 2, 0);
    }

    #[test]
    fn clock_inverters_and_enable_logic_stay_as_written() {
        let mut netlist = Netlist::new("gated");
        let [a, b, clock] = ["a", "b", "clk"].map(|name| netlist.add_input(name));
        let data = netlist.add_gate(Function::XOR, &[a, b]);
        let wanted = netlist.add_gate(Function::OR, &[a, b]);
        let enable = netlist.add_gate(Function::AND, &[clock, wanted]);
        let q = flip_flop(&mut netlist, "q", data, enable, false);
        netlist.add_output("q", q);
        check(&netlist, 0, 0, 2);
        check(&as_nands(&netlist), 4, 4, 3);
    }

    #[test]
    fn roles_do_not_depend_on_constant_or_shared_data() {
        let mut netlist = Netlist::new("constant");
        let clock = netlist.add_input("clk");
        let one = netlist.add_constant(true);
        for (name, data) in [("p", one), ("q", clock)] {
            let q = flip_flop(&mut netlist, name, data, clock, false);
            netlist.add_output(name, q);
        }
        check(&as_nands(&netlist), 8, 8, 1);
    }
}
