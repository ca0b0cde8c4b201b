//! The arenas of a circuit body under construction.

use crate::syntax::tree::{
    BodySyntax, ExpressionSyntax, ExpressionSyntaxId, ExpressionSyntaxKind, SizeSyntax, SizeSyntaxId, SizeSyntaxKind,
    StatementSyntax,
};
use nbc_base::source::Span;

#[derive(Default)]
pub(crate) struct Arena {
    pub(crate) expressions: Vec<ExpressionSyntax>,
    pub(crate) sizes: Vec<SizeSyntax>,
}

impl Arena {
    pub(crate) fn expression(&mut self, kind: ExpressionSyntaxKind, span: Span) -> ExpressionSyntaxId {
        self.expressions.push(ExpressionSyntax { kind, span });
        ExpressionSyntaxId(self.expressions.len() as u32 - 1)
    }

    pub(crate) fn size(&mut self, kind: SizeSyntaxKind, span: Span) -> SizeSyntaxId {
        self.sizes.push(SizeSyntax { kind, span });
        SizeSyntaxId(self.sizes.len() as u32 - 1)
    }

    pub(crate) fn span(&self, id: ExpressionSyntaxId) -> Span {
        self.expressions[id.0 as usize].span
    }

    pub(crate) fn body(self, statements: Vec<StatementSyntax>) -> BodySyntax {
        BodySyntax { statements, expressions: self.expressions, sizes: self.sizes }
    }
}
