//! Sizes, indices and arguments, as written, and where expressions are.

use nbc_base::source::Span;

use crate::syntax::tree::NameSyntax;

/// Index into [`BodySyntax::expressions`](crate::syntax::tree::BodySyntax::expressions).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ExpressionSyntaxId(pub u32);

/// Index into [`BodySyntax::sizes`](crate::syntax::tree::BodySyntax::sizes).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SizeSyntaxId(pub u32);

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Index {
    pub kind: IndexKind,
    pub span: Span,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum IndexKind {
    One(SizeSyntaxId),
    /// `[3..0]`: the highest and the lowest.
    Slice(SizeSyntaxId, SizeSyntaxId),
    /// `[{a, b}]`: a value that is no integer.
    Value(ExpressionSyntaxId),
}

#[derive(Clone, Debug, PartialEq)]
pub struct SizeSyntax {
    pub kind: SizeSyntaxKind,
    pub span: Span,
}

#[derive(Clone, Debug, PartialEq)]
pub enum SizeSyntaxKind {
    Literal(String),
    Name(String),
    Log2(SizeSyntaxId),
    Group(SizeSyntaxId),
    Binary(nbc_base::model::SizeOperator, SizeSyntaxId, SizeSyntaxId),
}

#[derive(Clone, Debug, PartialEq)]
pub struct Argument {
    pub name: Option<NameSyntax>,
    pub value: SizeSyntaxId,
    pub span: Span,
}
