//! Designs, the contents of an exchange file: a circuit and the registers of its state.

use crate::Netlist;

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

/// A register for one bit of state.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Register {
    /// The net that shows its value.
    pub name: String,
    /// When it takes its next value.
    pub kind: RegisterKind,
    /// The net that clocks it; `None` if the format has one clock without a name.
    pub clock: Option<String>,
    /// Its value before the first cycle, if known.
    pub start: Option<bool>,
}

impl Register {
    /// The clock of registers for which a file names none.
    pub const CLOCK: &str = "clk";

    /// The name of its clock.
    pub(crate) fn clock_name(&self) -> &str {
        self.clock.as_deref().unwrap_or(Self::CLOCK)
    }

    /// Its value before the first cycle in a swarm: 0 if the file does not say.
    pub fn starts_at(&self) -> bool {
        self.start.unwrap_or(false)
    }
}

/// A circuit and its registers.
#[derive(Clone, Debug)]
pub struct Design {
    /// The logic: its inputs are the ports and then a register's value each, its outputs the ports and then a
    /// register's next value each.
    pub logic: Netlist,
    /// The registers in order.
    pub registers: Vec<Register>,
}

impl Design {
    /// The number of input ports.
    pub fn inputs(&self) -> usize {
        self.logic.inputs().len() - self.registers.len()
    }

    /// The number of output ports.
    pub fn outputs(&self) -> usize {
        self.logic.outputs().len() - self.registers.len()
    }
}
