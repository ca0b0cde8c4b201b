//! Designs, the contents of an exchange file: a circuit and the registers of its state.

use std::collections::BTreeSet;

use crate::{NetId, Netlist};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RegisterKind {
    Rising,
    Falling,
    High,
    Low,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Forcing {
    #[default]
    Never,
    /// A reset gives it its start value as soon as it is 1, and keeps it while it is 1.
    ToStart,
    /// A set and a reset make it 1 and 0. The reset is stronger.
    SetReset,
}

impl Forcing {
    pub(crate) fn nets(self) -> &'static [&'static str] {
        match self {
            Self::Never => &[],
            Self::ToStart => &["reset"],
            Self::SetReset => &["set", "reset"],
        }
    }
}

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
