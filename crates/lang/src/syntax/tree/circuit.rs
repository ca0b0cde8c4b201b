//! Circuits and their statements, as written.

use nbc_base::model::Relation;
use nbc_base::source::Span;

use crate::syntax::tree::{ExpressionSyntax, ExpressionSyntaxId, Index, NameSyntax, SizeSyntax, SizeSyntaxId};

#[derive(Clone, Debug, PartialEq)]
pub struct CircuitSyntax {
    pub is_environment: bool,
    pub name: NameSyntax,
    pub parameters: Vec<ParameterSyntax>,
    pub inputs: Vec<Port>,
    pub outputs: Vec<Port>,
    /// It also has the sizes of the ports.
    pub body: BodySyntax,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct BodySyntax {
    pub statements: Vec<StatementSyntax>,
    /// Children before parents.
    pub expressions: Vec<ExpressionSyntax>,
    /// Children before parents.
    pub sizes: Vec<SizeSyntax>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct ParameterSyntax {
    pub name: NameSyntax,
    pub default: Option<SizeSyntaxId>,
}

/// A port or another net: `a`, `a[8]` or `r[32][8]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Port {
    pub name: NameSyntax,
    pub words: Option<SizeSyntaxId>,
    /// In bits; of an array, the width of a word.
    pub width: Option<SizeSyntaxId>,
    pub members: Option<NameSyntax>,
    /// The value of an input that a call leaves out: `enable = 1`.
    pub absent: Option<SizeSyntaxId>,
    /// The file with the first contents of a memory: `init program`.
    pub contents: Option<NameSyntax>,
}

impl Port {
    pub fn new(name: NameSyntax, width: Option<SizeSyntaxId>) -> Self {
        Self { name, words: None, width, members: None, absent: None, contents: None }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct StatementSyntax {
    pub kind: StatementKind,
    pub span: Span,
}

#[derive(Clone, Debug, PartialEq)]
pub enum StatementKind {
    Drive {
        targets: Vec<TargetSyntax>,
        grouping: Grouping,
        value: ExpressionSyntaxId,
    },
    Nets(Vec<Port>),
    For {
        variable: NameSyntax,
        from: SizeSyntaxId,
        /// One more than the last value.
        to: SizeSyntaxId,
        statements: Vec<StatementSyntax>,
    },
    Let {
        name: NameSyntax,
        value: SizeSyntaxId,
    },
    If {
        left: SizeSyntaxId,
        comparison: Relation,
        right: SizeSyntaxId,
        then: Vec<StatementSyntax>,
        /// What follows `else if` is one statement.
        otherwise: Vec<StatementSyntax>,
        blocks: [Span; 2],
    },
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grouping {
    Single,
    /// `(a, b) = …`: the outputs of a call.
    Outputs,
    /// `{a, b} = …`: the parts of a value.
    Joined,
}

#[derive(Clone, Debug, PartialEq)]
pub struct TargetSyntax {
    pub name: NameSyntax,
    pub index: Option<Index>,
    pub second: Option<Index>,
    pub start: Option<SizeSyntaxId>,
    pub span: Span,
}
