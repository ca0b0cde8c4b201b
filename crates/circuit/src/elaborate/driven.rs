//! Circuits of other tools' files: a netlist drives each bit.

use crate::elaborate::build::ModuleBuilder;
use crate::elaborate::module::{Bit, ModuleSignal};
use crate::index::ListIndex;
use nbc_base::model::{BitDriver, DrivenBit};

impl ModuleBuilder<'_, '_> {
    /// The nets have widths, so their bits are the first signals.
    pub(super) fn driven_bits(&mut self) {
        let first = self.module.inputs.iter().map(|port| port.width).sum::<u32>();
        for (net, &DrivenBit { driver, start }) in (first..).zip(&self.circuit.bits) {
            let signal = match driver {
                BitDriver::Bit(bit) => self.numbered(bit),
                BitDriver::Gate(function, pins) => {
                    let (pins, span) = (pins.map(|pin| self.numbered(pin)), self.span_of(net));
                    self.gate(function, pins, span)
                }
                BitDriver::Register(kind, forcing, pins) => {
                    let (pins, start) = (pins.map(|pin| self.numbered(pin)), start.unwrap_or(false));
                    self.signal(ModuleSignal::Register { kind, forcing, start, pins })
                }
            };
            self.drive_by(net, signal, start);
        }
    }

    pub(super) fn drive_by(&mut self, net: Bit, signal: Bit, start: Option<bool>) {
        if let ModuleSignal::Net { driver, .. } = &mut self.module.signals[net as usize] {
            *driver = Some(ListIndex::new(signal));
        }
        self.module.starts.extend(start.map(|start| (net, start)));
    }

    fn numbered(&mut self, bit: u32) -> Bit {
        bit.checked_sub(DrivenBit::CONSTANTS).unwrap_or_else(|| self.constant(bit == 1))
    }

    fn span_of(&self, bit: Bit) -> nbc_base::source::Span {
        match self.module.signals[bit as usize] {
            ModuleSignal::Net { net, .. } => self.module.nets[net as usize].span,
            _ => self.circuit.span,
        }
    }
}
