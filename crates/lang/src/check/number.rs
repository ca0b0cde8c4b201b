//! Numbers without a width, such as `15` and `0xff`. The advice names the width that their context has.

use crate::check::circuit::{Binding, CircuitChecker};
use crate::check::constant;
use crate::check::wording::CircuitError;
use crate::syntax::tree::{ExpressionSyntaxId, ExpressionSyntaxKind as Kind, Index, Infix, TargetSyntax};
use nbc_base::diag::suggest;
use nbc_base::model::{ExpressionKind, NetSlot, SizeId, SizeKind};

/// A place in the expression of a statement.
#[derive(Clone, Copy)]
pub(crate) struct NumberPlace<'a> {
    pub(crate) at: usize,
    pub(crate) root: ExpressionSyntaxId,
    pub(crate) targets: &'a [TargetSyntax],
}

/// What an expression asks of one of its parts.
enum Asked {
    Width(String),
    /// As wide as the expression itself.
    Whole,
    Nothing,
}

impl CircuitChecker<'_> {
    /// `0` and `1` are bits; any other number needs its width.
    pub(crate) fn digits(&mut self, text: &str, place: NumberPlace<'_>) -> ExpressionKind {
        if matches!(text, "0" | "1") {
            return ExpressionKind::Bits(vec![text == "1"]);
        }
        let (base, digits) = match text.as_bytes().get(1) {
            Some(b'x' | b'X') => ('h', &text[2..]),
            Some(b'b' | b'B') => ('b', &text[2..]),
            _ => ('d', text),
        };
        let value = constant::value(digits, constant::radix(base).expect("the three bases")).ok();
        let needed = value.map(|value| (u128::BITS - value.leading_zeros()).max(1));
        let written = match base {
            'h' => 4 * digits.len(),
            'b' => digits.len(),
            _ => needed.unwrap_or(8) as usize,
        };
        let fits = |width: &String| match width.parse::<u32>() {
            Ok(width) => needed.is_some_and(|needed| needed <= width),
            Err(_) => true,
        };
        let width = self.asked_width(place).filter(fits).unwrap_or_else(|| written.to_string());
        let constant = format!("{width}'{base}{digits}");
        let error =
            CircuitError::ConstantWithoutWidth { number: text.to_owned(), constant, is_certain: value.is_some() };
        self.diagnostics.push(error.at(self.body.expressions[place.at].span));
        ExpressionKind::Bits(vec![false])
    }

    /// The width that a part of an expression needs, as it would be written, if it is declared.
    fn asked_width(&self, place: NumberPlace<'_>) -> Option<String> {
        let body = self.body;
        if self.diagnostics.len() >= suggest::MOST {
            return None;
        }
        let mut at = place.at as u32;
        // The parts of an expression stand before it.
        for parent in place.at + 1..=place.root.0 as usize {
            match self.asked(&body.expressions[parent].kind, at) {
                Some(Asked::Width(width)) => return Some(width),
                Some(Asked::Whole) => at = parent as u32,
                Some(Asked::Nothing) => return None,
                None => {}
            }
        }
        match place.targets {
            [target] => {
                let Binding::Net(slot) = self.lookup(&target.name.text)? else { return None };
                self.width_of_bits(slot, target.index.as_ref())
            }
            _ => None,
        }
    }

    /// What `parent` asks of the expression `part`; `None` if it is not one of its parts.
    fn asked(&self, parent: &Kind, part: u32) -> Option<Asked> {
        let beside = |others: &[ExpressionSyntaxId]| {
            let width = others.iter().filter(|other| other.0 != part).find_map(|other| self.width_text(*other));
            width.map_or(Asked::Whole, Asked::Width)
        };
        let has = |parts: &[ExpressionSyntaxId]| parts.iter().any(|known| known.0 == part);
        match parent {
            Kind::Group(inner) | Kind::Not(inner) => has(&[*inner]).then_some(Asked::Whole),
            Kind::Infix { operator, left, right, .. } if has(&[*left, *right]) => {
                match (beside(&[*left, *right]), operator) {
                    (Asked::Whole, Infix::Bitwise(_) | Infix::Add | Infix::Subtract) => Some(Asked::Whole),
                    (Asked::Whole, _) => Some(Asked::Nothing),
                    (asked, _) => Some(asked),
                }
            }
            Kind::Operation { operands, .. } => has(operands).then(|| beside(operands)),
            Kind::Choice { condition, then, otherwise } => {
                let values = [*then, *otherwise];
                has(&values).then(|| beside(&values)).or(has(&[*condition]).then_some(Asked::Nothing))
            }
            Kind::Concatenation(parts)
            | Kind::Repetition { values: parts, .. }
            | Kind::Call { operands: parts, .. } => has(parts).then_some(Asked::Nothing),
            _ => None,
        }
    }

    /// The width of an expression that tells it by itself.
    fn width_text(&self, mut id: ExpressionSyntaxId) -> Option<String> {
        loop {
            match &self.body.expressions[id.0 as usize].kind {
                Kind::Group(inner) | Kind::Not(inner) => id = *inner,
                Kind::Constant { width, .. } | Kind::Computed { width, .. } => return self.size_text(*width),
                Kind::Net { name, index } => {
                    let Binding::Net(slot) = self.lookup(&name.text)? else { return None };
                    return self.width_of_bits(slot, index.as_ref());
                }
                _ => return None,
            }
        }
    }

    /// The width of a net or of some of its bits.
    fn width_of_bits(&self, slot: NetSlot, index: Option<&Index>) -> Option<String> {
        let Some(index) = index else { return self.declared_width(slot) };
        let Some(low) = index.low else { return Some("1".to_owned()) };
        let bit = |size| self.size_text(size)?.parse::<u32>().ok();
        Some((bit(index.high)?.checked_sub(bit(low)?)?.checked_add(1)?).to_string())
    }

    /// The declared width of a net, if it is a number or a parameter.
    fn declared_width(&self, slot: NetSlot) -> Option<String> {
        let is_port = (slot.0 as usize) < self.circuit.inputs + self.circuit.outputs;
        let Some(SizeId(size)) = self.circuit.nets[slot.0 as usize].width else {
            return is_port.then(|| "1".to_owned());
        };
        match self.circuit.sizes[size as usize].kind {
            SizeKind::Literal(width) => Some(width.to_string()),
            SizeKind::Variable(slot) => Some(self.circuit.parameters.get(slot as usize)?.name.clone()),
            _ => None,
        }
    }
}
