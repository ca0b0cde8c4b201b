//! Sizes of circuits: integers over parameters and loop variables.

use crate::check::circuit::{Binding, CircuitChecker};
use crate::check::constant;
use crate::check::wording;
use crate::syntax::tree;
use nbc_base::diag::{Diagnostic, Suggestion};
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

    pub(crate) fn copy_of_size(&mut self, size: SizeId) -> SizeId {
        let first = Size::first_part(&self.circuit.sizes, size);
        let shift = self.circuit.sizes.len() as u32 - first.0;
        let moved = |id: SizeId| SizeId(id.0 + shift);
        for at in first.0..=size.0 {
            let Size { kind, span } = self.circuit.sizes[at as usize];
            let kind = match kind {
                SizeKind::Log2(inner) => SizeKind::Log2(moved(inner)),
                SizeKind::Binary(operator, left, right) => SizeKind::Binary(operator, moved(left), moved(right)),
                leaf => leaf,
            };
            self.push_size(kind, span);
        }
        moved(size)
    }

    pub(crate) fn push_size(&mut self, kind: SizeKind, span: Span) -> SizeId {
        self.circuit.sizes.push(Size { kind, span });
        SizeId(self.circuit.sizes.len() as u32 - 1)
    }

    fn literal(&mut self, digits: &str, span: Span) -> SizeKind {
        let value = constant::integer(digits).unwrap_or_else(|| {
            self.diagnostics.push(wording::large_number(127, span));
            1
        });
        SizeKind::Literal(value)
    }

    fn number(&mut self, name: &str, span: Span) -> SizeKind {
        let error = match self.lookup(name) {
            Some(binding @ Binding::Variable(slot, _)) => {
                self.refer(span, binding);
                return SizeKind::Variable(slot);
            }
            Some(Binding::Net(slot)) => {
                self.used[slot.0 as usize] = true;
                wording::net_for_number(name, span)
            }
            None => match self.declared.integer(name, span, self.home) {
                Some(Ok(value)) => return SizeKind::Literal(value),
                Some(Err(fault)) => fault,
                None => wording::unknown_number(name, &Suggestion::of(name, self.numbers_in_scope()), span),
            },
        };
        self.diagnostics.push(error);
        SizeKind::Literal(1)
    }

    fn numbers_in_scope(&self) -> impl Iterator<Item = &str> {
        self.scopes
            .iter()
            .rev()
            .flatten()
            .filter_map(|(name, binding)| matches!(binding, Binding::Variable(..)).then_some(*name))
            .chain(self.declared.names.integers.all())
            .chain(self.declared.names.members.all())
    }
}

pub(crate) fn value(
    sizes: &[tree::SizeSyntax],
    known: impl Fn(&str, Span) -> Option<Result<i128, Diagnostic>>,
) -> Result<i128, Diagnostic> {
    let mut values: Vec<i128> = Vec::with_capacity(sizes.len());
    for size in sizes {
        let at = |id: tree::SizeSyntaxId| values[id.0 as usize];
        let value = match &size.kind {
            tree::SizeSyntaxKind::Literal(digits) => constant::integer(digits),
            tree::SizeSyntaxKind::Name(name) => match known(name, size.span) {
                Some(value) => Some(value?),
                None => return Err(wording::unknown_number(name, &Suggestion::None, size.span)),
            },
            tree::SizeSyntaxKind::Log2(inner) => Some(SizeKind::log2(at(*inner))),
            tree::SizeSyntaxKind::Group(inner) => Some(at(*inner)),
            tree::SizeSyntaxKind::Binary(operator, left, right) => operator.apply(at(*left), at(*right)),
        };
        values.push(value.ok_or_else(|| wording::large_number(127, size.span))?);
    }
    Ok(*values.last().expect("an integer has a size"))
}

/// The first size of the contiguous range that ends with `root`.
pub(crate) fn first_leaf(sizes: &[tree::SizeSyntax], root: tree::SizeSyntaxId) -> u32 {
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
