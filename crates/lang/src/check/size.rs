//! Sizes of circuits: integers over parameters and loop variables.

use crate::check::circuit::{Binding, CircuitChecker};
use crate::check::wording::{NameError, ValueError};
use crate::syntax::tree;
use nbc_base::diag::Suggestion;
use nbc_base::model::{Size, SizeId, SizeKind};
use nbc_base::source::Span;

impl CircuitChecker<'_> {
    /// Resolves an integer expression from its leaves to its root without recursion.
    pub(crate) fn size(&mut self, root: tree::SizeSyntaxId) -> SizeId {
        let body = self.body;
        let mut done: Vec<SizeId> = Vec::new();
        for at in first_leaf(&body.sizes, root) as usize..=root.0 as usize {
            let size = &body.sizes[at];
            let kind = match &size.kind {
                tree::SizeSyntaxKind::Group(_) => continue,
                tree::SizeSyntaxKind::Literal(digits) => self.literal(digits, size.span),
                tree::SizeSyntaxKind::Name(name) => self.number(name, size.span),
                tree::SizeSyntaxKind::Log2(_) => SizeKind::Log2(done.pop().expect("an operand")),
                tree::SizeSyntaxKind::Binary(operator, ..) => {
                    let right = done.pop().expect("a right operand");
                    SizeKind::Binary(*operator, done.pop().expect("a left operand"), right)
                }
            };
            done.push(self.push_size(kind, size.span));
        }
        done.pop().expect("a size has a value")
    }

    pub(crate) fn one(&mut self, span: Span) -> SizeId {
        self.push_size(SizeKind::Literal(1), span)
    }

    fn push_size(&mut self, kind: SizeKind, span: Span) -> SizeId {
        self.circuit.sizes.push(Size { kind, span });
        SizeId(self.circuit.sizes.len() as u32 - 1)
    }

    fn literal(&mut self, digits: &str, span: Span) -> SizeKind {
        let value = digits.parse::<u32>().unwrap_or_else(|_| {
            self.diagnostics.push(ValueError::TooLarge.at(span));
            1
        });
        SizeKind::Literal(value.into())
    }

    fn number(&mut self, name: &str, span: Span) -> SizeKind {
        let name = name.to_owned();
        let error = match self.lookup(&name) {
            Some(binding @ Binding::Variable(slot, _)) => {
                self.refer(span, binding);
                return SizeKind::Variable(slot);
            }
            Some(Binding::Net(slot)) => {
                self.used[slot.0 as usize] = true;
                NameError::NetForNumber { name }
            }
            None => NameError::UnknownNumber { meant: Suggestion::of(&name, self.numbers_in_scope()), name },
        };
        self.diagnostics.push(error.at(span));
        SizeKind::Literal(1)
    }

    fn numbers_in_scope(&self) -> impl Iterator<Item = &str> {
        self.scopes
            .iter()
            .rev()
            .flatten()
            .filter_map(|(name, binding)| matches!(binding, Binding::Variable(..)).then_some(*name))
    }
}

/// The first size of the contiguous range that ends with `root`.
fn first_leaf(sizes: &[tree::SizeSyntax], root: tree::SizeSyntaxId) -> u32 {
    let mut at = root;
    loop {
        at = match sizes[at.0 as usize].kind {
            tree::SizeSyntaxKind::Literal(_) | tree::SizeSyntaxKind::Name(_) => return at.0,
            tree::SizeSyntaxKind::Log2(inner)
            | tree::SizeSyntaxKind::Group(inner)
            | tree::SizeSyntaxKind::Binary(_, inner, _) => inner,
        };
    }
}
