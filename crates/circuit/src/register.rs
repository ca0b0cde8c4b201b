//! Registers: one bit of state each, as nodes of a netlist.

pub use nbc_base::model::{Forcing, RegisterKind};
use nbc_base::source::Span;

/// A register in a netlist. Its pins are its data, its clock, and then the nets that force it.
#[derive(Clone, Debug, PartialEq)]
pub struct RegisterNode {
    pub kind: RegisterKind,
    pub forcing: Forcing,
    /// 0 if it is not known.
    pub start: Option<bool>,
    pub name: Option<String>,
    pub span: Option<Span>,
}

impl RegisterNode {
    pub const DATA: u8 = 0;
    pub const CLOCK: u8 = 1;
    /// The cells that it becomes, roughly.
    pub(crate) const CELLS: usize = 8;

    pub fn starts_at(&self) -> bool {
        self.start.unwrap_or(false)
    }

    pub(crate) fn pins(&self) -> usize {
        2 + self.forcing.nets().len()
    }
}
