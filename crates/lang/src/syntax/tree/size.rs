//! Sizes, indices and arguments, as written, and where expressions are.

use nbc_base::source::Span;

use crate::syntax::tree::NameSyntax;

/// The place of an expression in [`BodySyntax::expressions`](crate::syntax::tree::BodySyntax::expressions).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ExpressionSyntaxId(pub u32);

/// The place of a size in [`BodySyntax::sizes`](crate::syntax::tree::BodySyntax::sizes).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SizeSyntaxId(pub u32);

/// The bits of a net: `[3]` or `[3..0]`; the word of an array: `[3]` or `[address]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Index {
    /// What selects.
    pub kind: IndexKind,
    /// The place, including the brackets.
    pub span: Span,
}

/// What selects bits or a word.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum IndexKind {
    /// `[3]`
    One(SizeSyntaxId),
    /// `[3..0]`: the highest and the lowest.
    Slice(SizeSyntaxId, SizeSyntaxId),
    /// `[{a, b}]`: a value that is no integer.
    Value(ExpressionSyntaxId),
}

/// An integer with its place.
#[derive(Clone, Debug, PartialEq)]
pub struct SizeSyntax {
    /// A number, a name or an operation.
    pub kind: SizeSyntaxKind,
    /// The place of the integer in the source.
    pub span: Span,
}

/// An integer: a number, a name, or an operation on others.
#[derive(Clone, Debug, PartialEq)]
pub enum SizeSyntaxKind {
    /// A number, as its digits.
    Literal(String),
    /// A parameter or loop variable.
    Name(String),
    /// `log2(n)`
    Log2(SizeSyntaxId),
    /// `(n)`
    Group(SizeSyntaxId),
    /// `n + 1`
    Binary(nbc_base::model::SizeOperator, SizeSyntaxId, SizeSyntaxId),
}

/// A parameter given to a circuit: `8` or `start = 1`.
#[derive(Clone, Debug, PartialEq)]
pub struct Argument {
    /// The name of the parameter, if it is given.
    pub name: Option<NameSyntax>,
    /// The value for the parameter.
    pub value: SizeSyntaxId,
    /// The place of the argument in the source.
    pub span: Span,
}
