//! Designs, the contents of an exchange file: a circuit and the registers of its state.

use std::collections::{BTreeMap, BTreeSet};

use crate::register::{Forcing, RegisterKind};
use crate::{Loops, NetId, Netlist, Node, RegisterNode};

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Register {
    pub name: String,
    pub kind: RegisterKind,
    /// The net that clocks it; `None` if the format has one clock without a name.
    pub clock: Option<String>,
    pub start: Option<bool>,
    pub forcing: Forcing,
}
impl Register {
    /// The clock of registers for which a file names none.
    pub const CLOCK: &str = "clk";

    /// A register without a start value that takes its next value when the clock rises.
    pub(crate) fn flip_flop(name: String, clock: &str) -> Self {
        let (kind, clock, forcing) = (RegisterKind::Rising, Some(clock.to_owned()), Forcing::Never);
        Self { name, kind, clock, start: None, forcing }
    }

    pub(crate) fn outputs(registers: &[Self]) -> usize {
        registers.iter().map(|register| 1 + register.forcing.nets().len()).sum()
    }

    pub(crate) fn clock_name(&self) -> &str {
        self.clock.as_deref().unwrap_or(Self::CLOCK)
    }

    /// 0 if the file does not say.
    pub fn starts_at(&self) -> bool {
        self.start.unwrap_or(false)
    }
}

#[derive(Clone, Debug)]
pub struct Design {
    /// The logic: its inputs are the ports and then a register's value each, its outputs the ports, then a register's
    /// next value each, and then the nets that force registers.
    pub logic: Netlist,
    pub registers: Vec<Register>,
    /// The buses whose leftmost bit has the lowest number, such as `a` of `input [0:3] a` in Verilog.
    pub ascending: BTreeSet<String>,
}

impl Design {
    pub fn new(logic: Netlist, registers: Vec<Register>) -> Self {
        Self { logic, registers, ascending: BTreeSet::new() }
    }

    pub fn inputs(&self) -> usize {
        self.logic.inputs().len() - self.registers.len()
    }

    pub fn outputs(&self) -> usize {
        self.logic.outputs().len() - Register::outputs(&self.registers)
    }

    /// The clocks that no input or register has the name of.
    pub(crate) fn own_clocks(&self) -> BTreeSet<&str> {
        let known: BTreeSet<String> = self.logic.inputs().iter().map(|&id| self.logic.net_name(id)).collect();
        self.registers.iter().map(Register::clock_name).filter(|&clock| !known.contains(clock)).collect()
    }

    /// The design as one netlist, in which registers are nodes. A clock that is not an input becomes one.
    pub fn netlist(&self) -> Netlist {
        self.netlist_with(&self.own_clocks()).0
    }

    /// As [`Self::netlist`], with these additional inputs; also the registers, in order.
    pub(crate) fn netlist_with(&self, clocks: &BTreeSet<&str>) -> (Netlist, Vec<NetId>) {
        let logic = &self.logic;
        let mut netlist = Netlist::with_blocks_of(logic);
        let (ports, states) = logic.inputs().split_at(self.inputs());
        let (outputs, nexts) = logic.outputs().split_at(self.outputs());
        let mut net: BTreeMap<NetId, NetId> = BTreeMap::new();
        for &id in ports {
            net.insert(id, netlist.add_input(logic.net_name(id)));
        }
        let mut by_name: BTreeMap<String, NetId> =
            clocks.iter().map(|&clock| (clock.to_owned(), netlist.add_input(clock))).collect();
        let mut registers = Vec::new();
        for (&id, register) in states.iter().zip(&self.registers) {
            let Register { name, kind, start, forcing, .. } = register.clone();
            registers.push(netlist.add_loose_register(RegisterNode {
                kind,
                forcing,
                start,
                name: Some(name),
                span: None,
            }));
            net.extend(registers.last().map(|&made| (id, made)));
        }
        copy(logic, &mut netlist, &mut net);
        for id in logic.ids().filter(|id| !matches!(logic.node(*id), Node::Output(_) | Node::Constant(_))) {
            by_name.entry(logic.net_name(id)).or_insert(net[&id]);
        }
        let forcing = self.forcing_nets();
        for ((register, made), (&next, forcing)) in self.registers.iter().zip(&registers).zip(nexts.iter().zip(forcing))
        {
            let clock = by_name[register.clock_name()];
            let pins = [net[&logic.pins(next)[0]], clock].into_iter().chain(forcing.iter().map(|pin| net[pin]));
            (0..).zip(pins).for_each(|(pin, driver)| netlist.connect(*made, pin, driver));
        }
        for &id in outputs {
            netlist.add_output(logic.net_name(id), net[&logic.pins(id)[0]]);
        }
        (netlist, registers)
    }

    pub(crate) fn forcing(&self) -> Vec<&[NetId]> {
        let mut rest = &self.logic.outputs()[self.outputs() + self.registers.len()..];
        let mut next = |register: &Register| rest.split_off(..register.forcing.nets().len()).expect("one for each net");
        self.registers.iter().map(&mut next).collect()
    }

    pub(crate) fn forcing_nets(&self) -> Vec<Vec<NetId>> {
        let driver = |&output: &NetId| self.logic.pins(output)[0];
        self.forcing().into_iter().map(|outputs| outputs.iter().map(driver).collect()).collect()
    }
}

fn copy(logic: &Netlist, netlist: &mut Netlist, net: &mut BTreeMap<NetId, NetId>) {
    let mut made = Vec::new();
    for &id in Loops::of(logic).order() {
        let copy = match logic.node(id) {
            Node::Constant(value) => netlist.add_constant(*value),
            Node::Cell(cell) => netlist.add_loose_cell(cell.clone()),
            Node::Wire { name, start, span } => netlist.add_wire(name, *start, *span),
            Node::Input(_) | Node::Output(_) | Node::Register(_) => continue,
        };
        netlist.put_into(copy, logic.block(id));
        net.insert(id, copy);
        made.push((id, copy));
    }
    for (id, copy) in made {
        for (pin, driver) in (0..).zip(logic.pins(id)) {
            netlist.connect(copy, pin, net[&driver]);
        }
    }
}
