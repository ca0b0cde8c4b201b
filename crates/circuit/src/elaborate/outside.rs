//! Values that select words of arrays and bits of nets, and may be outside of them. What is outside shows 0, and
//! nothing can be written there.

use crate::elaborate::build::ModuleBuilder;
use crate::elaborate::module::Bit;
use crate::elaborate::wording::{ElaborateError, RangeError};
use nbc_base::model::{ExpressionId, ExpressionKind, NetSlot};

/// What a value selects a part of.
pub(super) struct IndexedNet {
    pub(super) name: String,
    /// The number of its words, or of its bits.
    pub(super) count: u32,
    /// Whether its parts are the words of an array.
    pub(super) is_word: bool,
}

impl ModuleBuilder<'_, '_> {
    /// The number of words of an array or a memory.
    pub(super) fn words_of(&mut self, array: NetSlot, frame: u32) -> Option<u32> {
        match self.circuit.memories.iter().find(|memory| memory.net == array) {
            Some(memory) => self.width(memory.words, 0),
            None => self.module.nets[self.net(array, frame)].words,
        }
    }

    /// Warns of a value that can be outside, and refuses a constant that is.
    pub(super) fn look_outside(&mut self, selected: IndexedNet, index: ExpressionId, value: &[Bit]) {
        let IndexedNet { name: net, count, is_word } = selected;
        let number = |is_one: &dyn Fn(Bit) -> bool| {
            value.iter().rev().fold(0u64, |number, &bit| number << 1 | u64::from(is_one(bit)))
        };
        let (least, most) = (number(&|bit| self.is_constant(bit, true)), number(&|bit| !self.is_constant(bit, false)));
        if most < u64::from(count) || self.is_always_inside(index, count) {
            return;
        }
        let span = self.span(index);
        let fault = match (least == most, is_word) {
            (true, true) => RangeError::NoSuchWord { net, word: least as i128, words: count }.at(span),
            (true, false) => RangeError::NoSuchBit { net, bit: least as i128, width: count }.at(span),
            (false, _) => ElaborateError::IndexOutside { net, count, most, is_word }.at(span),
        };
        self.fault(fault);
    }

    /// The same for the operands of `select`.
    pub(super) fn look_selected(&mut self, operands: &[Option<ExpressionId>], values: &[Option<Vec<Bit>>]) {
        let ([Some(of), Some(index)], [Some(bits), Some(value)]) = (operands, values) else { return };
        let name = self.operand(*of, bits).net.unwrap_or_else(|| "a".to_owned());
        self.look_outside(IndexedNet { name, count: bits.len() as u32, is_word: false }, *index, value);
    }

    /// Whether a value is a net with an enumeration whose members are all inside.
    fn is_always_inside(&self, index: ExpressionId, count: u32) -> bool {
        let ExpressionKind::Net(slot) = self.circuit.expressions[index.0 as usize].kind else { return false };
        let members = self.circuit.nets[slot.0 as usize].members;
        let declared = members.and_then(|place| self.builder.program.enumerations.get(place));
        declared.is_some_and(|declared| declared.members.iter().all(|member| member.value < count.into()))
    }
}
