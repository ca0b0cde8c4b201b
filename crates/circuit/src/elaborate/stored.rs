//! The circuit of the prelude that the compiler makes: a register for each bit of a value.

use crate::elaborate::build::ModuleBuilder;
use crate::elaborate::module::{ModuleNet, ModuleSignal};
use crate::elaborate::wording;
use crate::register::{Forcing, RegisterKind};

/// The bits of an integer.
const START_BITS: u32 = 127;

impl ModuleBuilder<'_, '_> {
    /// Its parameters are the width, whether the clock takes the data by an edge, what forces it, and the start value;
    /// its ports the data, the clock, a set, a reset, and the value.
    pub(super) fn stored(&mut self, arguments: &[i128]) -> Option<()> {
        let &[_, edge, forcing, start] = arguments else { unreachable!("the prelude declares its parameters") };
        let [data, clock, set, reset, shown] = [0, 1, 2, 3, 4].map(|net: usize| {
            let ModuleNet { first, width, .. } = self.module.nets[net];
            (first, width.unwrap_or_default())
        });
        if start < 0 {
            self.fault(wording::start_value(start, data.1, self.circuit.span));
            return None;
        }
        let kind = if edge == 1 { RegisterKind::Rising } else { RegisterKind::High };
        let forcing = match forcing {
            0 => Forcing::Never,
            1 => Forcing::ToStart,
            _ => Forcing::SetReset,
        };
        for bit in 0..data.1 {
            let start = bit < START_BITS && start >> bit & 1 == 1;
            let pins = [data.0 + bit, clock.0, set.0, reset.0];
            let register = self.signal(ModuleSignal::Register { kind, forcing, start, pins });
            self.drive_by(shown.0 + bit, register, Some(start));
        }
        Some(())
    }
}
