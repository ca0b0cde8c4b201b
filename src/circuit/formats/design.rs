//! Designs: what the exchange formats hold, a circuit without loops and the registers that close its state over it.

use crate::circuit::Netlist;

/// When a register takes its next value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RegisterKind {
    /// When the clock rises.
    Rising,
    /// When the clock falls.
    Falling,
    /// While the clock is 1.
    High,
    /// While the clock is 0.
    Low,
}

/// A place where a bit of state is kept.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Register {
    /// The net that shows its value.
    pub name: String,
    /// When it takes its next value.
    pub kind: RegisterKind,
    /// The net that clocks it; none where the format has one clock for all and no name for it.
    pub clock: Option<String>,
    /// Its value before the first cycle, where it is known.
    pub start: Option<bool>,
}

/// A circuit and its registers.
#[derive(Clone, Debug)]
pub struct Design {
    /// The logic: its inputs are the ports and then a register's value each, its outputs the ports and then a register's next
    /// value each.
    pub logic: Netlist,
    /// The registers in order.
    pub registers: Vec<Register>,
}

impl Design {
    /// How many input ports there are.
    pub fn inputs(&self) -> usize {
        self.logic.inputs().len() - self.registers.len()
    }

    /// How many output ports there are.
    pub fn outputs(&self) -> usize {
        self.logic.outputs().len() - self.registers.len()
    }
}
