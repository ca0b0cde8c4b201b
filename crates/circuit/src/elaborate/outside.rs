//! Values that select words of arrays and bits of nets, and may be outside of them. What is outside shows 0, and
//! nothing can be written there.

use crate::elaborate::build::ModuleBuilder;
use crate::elaborate::module::Bit;
use crate::elaborate::wording;
use nbc_base::model::{ExpressionId, ExpressionKind, NetSlot};

impl ModuleBuilder<'_, '_> {
    pub(super) fn words_of(&mut self, array: NetSlot, frame: u32) -> Option<u32> {
        match self.circuit.memories.iter().find(|memory| memory.net == array) {
            Some(memory) => self.width(memory.words, 0),
            None => self.module.nets[self.net(array, frame)].words,
        }
    }

    /// Warns of a value that can select beyond the last of `count`, and refuses a constant that does.
    pub(super) fn look_outside(
        &mut self,
        net: &str,
        (count, is_word): (u32, bool),
        index: ExpressionId,
        value: &[Bit],
    ) {
        let number = |is_one: &dyn Fn(Bit) -> bool| {
            value.iter().rev().fold(0u64, |number, &bit| number << 1 | u64::from(is_one(bit)))
        };
        let least = number(&|bit| self.constant_of(bit) == Some(true));
        let most = number(&|bit| self.constant_of(bit) != Some(false));
        if most < u64::from(count) || self.is_always_inside(index, count) {
            return;
        }
        let span = self.span(index);
        let fault = match (least == most, is_word) {
            (true, true) => wording::no_such_word(net, least as i128, count, span),
            (true, false) => wording::no_such_bit(net, least as i128, count, span),
            (false, _) => wording::index_outside(net, count, most, is_word, span),
        };
        self.fault(fault);
    }

    pub(super) fn look_selected(&mut self, operands: &[Option<ExpressionId>], values: &[Option<Vec<Bit>>]) {
        let ([Some(of), Some(index)], [Some(bits), Some(value)]) = (operands, values) else { return };
        let net = self.operand(*of, bits).net;
        self.look_outside(net.as_deref().unwrap_or("a"), (bits.len() as u32, false), *index, value);
    }

    fn is_always_inside(&self, index: ExpressionId, count: u32) -> bool {
        let ExpressionKind::Net(slot) = self.circuit.expressions[index.0 as usize].kind else { return false };
        let members = self.circuit.nets[slot.0 as usize].members;
        let declared = members.and_then(|place| self.builder.program.enumerations.get(place));
        declared.is_some_and(|declared| declared.members.iter().all(|member| member.value < count.into()))
    }
}
