//! The syntax tree: declarations as written, with unresolved names. Expressions and sizes are stored in arenas,
//! children before parents, so that deep nesting needs no deep stack.

mod circuit;
mod expression;
mod moved;
mod prove;
mod record;
mod size;
mod test;

use std::sync::Arc;

use nbc_base::source::Span;

pub use circuit::{
    BodySyntax, CircuitSyntax, Grouping, ParameterSyntax, Port, StatementKind, StatementSyntax, TargetSyntax,
};
pub use expression::{ExpressionSyntax, ExpressionSyntaxKind, Infix, OperandSyntax, TableOutputSyntax, TableRowSyntax};
pub(crate) use moved::moved;
pub use prove::{PropertySyntax, Prove};
pub use record::{
    Field, InstanceSyntax, Number, Quantity, RecordDeclaration, RecordKeyword, RecordSyntax, ScheduleSyntax,
    SpellSyntax, StimulusSyntax, ValueKind, ValueSyntax,
};
pub use size::{Argument, ExpressionSyntaxId, Index, IndexKind, SizeSyntax, SizeSyntaxId, SizeSyntaxKind};
pub use test::{Simulate, Test, TestItem, TestKind, TestRowSyntax, TestTable, UntilSyntax, With};

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tree {
    pub declarations: Vec<Arc<Declaration>>,
    pub broken: Vec<BrokenSyntax>,
    /// Each from its `//` to the end of its line.
    pub comments: Vec<Span>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BrokenSyntax {
    pub span: Span,
    pub declaration: Span,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Declaration {
    pub span: Span,
    pub kind: DeclarationKind,
}

#[derive(Clone, Debug, PartialEq)]
pub enum DeclarationKind {
    Use(Vec<Text>),
    Stimulus(Vec<StimulusSyntax>),
    Record(RecordDeclaration),
    Schedule(ScheduleSyntax),
    Simulate(Simulate),
    Circuit(CircuitSyntax),
    Enumeration(EnumerationSyntax),
    Let(LetSyntax),
    File(FileSyntax),
    Prove(Prove),
    Test(Test),
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NameSyntax {
    pub text: String,
    pub span: Span,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Text {
    /// Without the quotes.
    pub text: String,
    /// With the quotes.
    pub span: Span,
}

#[derive(Clone, Debug, PartialEq)]
pub struct EnumerationSyntax {
    pub name: NameSyntax,
    pub encoding: Option<NameSyntax>,
    pub members: Vec<MemberSyntax>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct MemberSyntax {
    pub name: NameSyntax,
    pub value: Option<NameSyntax>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct LetSyntax {
    pub name: NameSyntax,
    /// In an arena of its own.
    pub sizes: Vec<SizeSyntax>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct FileSyntax {
    pub name: NameSyntax,
    /// The command line may name another file.
    pub path: Text,
}
