//! Registers as multiplexers that read themselves: each shows its data while it is open, and else what it showed before
//! (docs/timing.md, "Latches of one robot").
//!
//! This is safe because the multiplexer does not glitch: when it closes, it shows the same before and after, and both
//! latches of an edge see it in the same cycle.

use crate::cells::CellLibrary;
use crate::lowering::Lowering;
use crate::register::RegisterKind;
use crate::{NetId, RegisterNode};
use nbc_base::model::Function;

/// The multiplexer that shows its second input while the first is 1, and else the third; and that for the opposite.
const OPEN_HIGH: Function = Function::MUX;
const OPEN_LOW: Function = Function::three(0xac);

/// Whether a library has the multiplexers without glitches that registers of this form need.
pub fn has_multiplexers(library: &CellLibrary) -> bool {
    let is_steady = |function| library.get(function).is_some_and(|kind| !kind.glitches);
    [OPEN_HIGH, OPEN_LOW].into_iter().all(is_steady)
}

impl Lowering<'_> {
    pub(super) fn multiplexers(&mut self, register: &RegisterNode, name: &str, pins: &[NetId]) -> NetId {
        let held = format!("{name}.held");
        let start = register.starts_at();
        let mut latch = |name: &str, function, data| {
            let own = self.kept(name.to_owned(), start);
            self.made.clear();
            let cell = self.cell(function, &[pins[1], data, own]);
            self.netlist.connect(own, 0, cell);
            self.note(cell, pins[1], function == OPEN_HIGH);
            own
        };
        match register.kind {
            RegisterKind::High => latch(name, OPEN_HIGH, pins[0]),
            RegisterKind::Low => latch(name, OPEN_LOW, pins[0]),
            RegisterKind::Rising => {
                let held = latch(&held, OPEN_LOW, pins[0]);
                latch(name, OPEN_HIGH, held)
            }
            RegisterKind::Falling => {
                let held = latch(&held, OPEN_HIGH, pins[0]);
                latch(name, OPEN_LOW, held)
            }
        }
    }
}
