//! Designs, the contents of an exchange file.

use std::collections::{BTreeMap, BTreeSet};

use crate::{NetId, Netlist, Node, RegisterNode};

#[derive(Clone, Debug)]
pub struct Design {
    /// Its registers are nodes, each with a name of its own.
    pub netlist: Netlist,
    /// The clocks that are not ports, such as that of AIGER, which has no name: the last inputs.
    pub clocks: usize,
    /// The buses whose leftmost bit has the lowest number, such as `a` of `input [0:3] a` in Verilog.
    pub ascending: BTreeSet<String>,
}

impl Design {
    /// The clock of registers for which a file names none.
    pub const CLOCK: &str = "clk";

    pub fn new(netlist: Netlist) -> Self {
        Self { netlist, clocks: 0, ascending: BTreeSet::new() }
    }

    pub fn ports(&self) -> &[NetId] {
        let inputs = self.netlist.inputs();
        &inputs[..inputs.len() - self.clocks]
    }

    pub fn own_clocks(&self) -> &[NetId] {
        &self.netlist.inputs()[self.ports().len()..]
    }

    /// The input or register with this name, or else a clock of this name that is not a port.
    pub(crate) fn clock(&mut self, name: &str) -> NetId {
        let registers = self.netlist.registers().map(|(id, _)| id);
        let known =
            self.netlist.inputs().iter().copied().chain(registers).find(|&id| self.netlist.net_name(id) == name);
        known.unwrap_or_else(|| {
            self.clocks += 1;
            self.netlist.add_input(name)
        })
    }

    /// The logic between registers: the value of each is an input after the ports, and its data and what forces it are
    /// outputs.
    pub fn opened(&self) -> Netlist {
        let mut logic = self.netlist.clone();
        let registers: Vec<(NetId, String)> =
            self.netlist.registers().map(|(id, _)| (id, self.netlist.net_name(id))).collect();
        for (id, name) in &registers {
            logic.replace_register(*id, Node::Input(name.clone()));
        }
        for (id, name) in &registers {
            logic.add_output(format!("{name}_next"), self.netlist.pins(*id)[0]);
        }
        for (id, name) in &registers {
            let words = self.netlist.register(*id).map_or(&[][..], |register| register.forcing.nets());
            for (word, &pin) in words.iter().zip(&self.netlist.pins(*id)[2..]) {
                logic.add_output(format!("{name}_{word}"), pin);
            }
        }
        self.own_clocks().iter().for_each(|&clock| logic.remove(clock));
        logic
    }

    /// The design with other logic between its registers, which is opened as [`Self::opened`] does.
    pub fn closed(&self, logic: Netlist) -> Self {
        let mut netlist = logic;
        let inputs: Vec<NetId> = netlist.inputs().to_vec();
        let outputs: Vec<NetId> = netlist.outputs()[self.netlist.outputs().len()..].to_vec();
        let registers: Vec<(NetId, RegisterNode)> =
            self.netlist.registers().map(|(id, register)| (id, register.clone())).collect();
        let (nexts, mut forcing) = outputs.split_at(registers.len());
        let own = self.ports().iter().copied().chain(registers.iter().map(|(id, _)| *id));
        let mut made: BTreeMap<NetId, NetId> = own.zip(inputs).collect();
        for &clock in self.own_clocks() {
            made.insert(clock, netlist.add_input(self.netlist.net_name(clock)));
        }
        for ((id, register), &next) in registers.into_iter().zip(nexts) {
            let count = register.forcing.nets().len();
            let forced = forcing.split_off(..count).unwrap_or_default();
            let mut pins: Vec<NetId> = std::iter::once(&next).chain(forced).map(|&pin| netlist.pins(pin)[0]).collect();
            pins.insert(1, made[&self.netlist.pins(id)[1]]);
            netlist.replace_input(made[&id], Node::Register(register));
            (0..).zip(pins).for_each(|(pin, net)| netlist.connect(made[&id], pin, net));
        }
        outputs.into_iter().for_each(|output| netlist.remove(output));
        Self { netlist, ..self.clone() }
    }
}
