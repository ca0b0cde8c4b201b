//! The arenas of a circuit body under construction.

use crate::source::Span;
use crate::syntax::tree::{Body, Expression, ExpressionId, ExpressionKind, Size, SizeId, SizeKind, Statement};

/// The expressions and sizes of a body that is being made.
#[derive(Default)]
pub(crate) struct Arena {
    pub(crate) expressions: Vec<Expression>,
    pub(crate) sizes: Vec<Size>,
}

impl Arena {
    pub(crate) fn expression(&mut self, kind: ExpressionKind, span: Span) -> ExpressionId {
        self.expressions.push(Expression { kind, span });
        ExpressionId(self.expressions.len() as u32 - 1)
    }

    pub(crate) fn size(&mut self, kind: SizeKind, span: Span) -> SizeId {
        self.sizes.push(Size { kind, span });
        SizeId(self.sizes.len() as u32 - 1)
    }

    pub(crate) fn span(&self, id: ExpressionId) -> Span {
        self.expressions[id.0 as usize].span
    }

    pub(crate) fn body(self, statements: Vec<Statement>) -> Body {
        Body { statements, expressions: self.expressions, sizes: self.sizes }
    }
}
