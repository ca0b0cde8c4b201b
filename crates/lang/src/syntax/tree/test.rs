//! Simulations and tests, as written.

use nbc_base::source::Span;

use crate::syntax::tree::{BodySyntax, InstanceSyntax, NameSyntax, Number, Quantity, SpellSyntax, Text};

#[derive(Clone, Debug, PartialEq)]
pub struct Simulate {
    pub swarm: NameSyntax,
    pub world: Option<NameSyntax>,
    pub with: With,
}

#[derive(Clone, Debug, PartialEq)]
pub enum With {
    Named(NameSyntax),
    Spells { columns: Vec<NameSyntax>, spells: Vec<SpellSyntax> },
}

#[derive(Clone, Debug, PartialEq)]
pub struct Test {
    pub circuit: InstanceSyntax,
    pub title: Option<Text>,
    pub environment: Option<NameSyntax>,
    pub worlds: Vec<NameSyntax>,
    pub kind: TestKind,
}

#[derive(Clone, Debug, PartialEq)]
pub enum TestKind {
    Table(TestTable),
    FromFile {
        /// Relative to the folder of the source.
        path: Text,
        at_least: Option<Quantity>,
    },
    Against(InstanceSyntax),
    Ever(InstanceSyntax),
    Reference(Box<BodySyntax>),
}

#[derive(Clone, Debug, PartialEq)]
pub struct TestTable {
    pub inputs: Vec<NameSyntax>,
    pub outputs: Vec<NameSyntax>,
    pub rows: Vec<TestItem>,
    pub header: Span,
}

#[derive(Clone, Debug, PartialEq)]
pub enum TestItem {
    Row(Box<TestRowSyntax>),
    Repeat {
        times: Number,
        rows: Vec<TestItem>,
        /// With the braces.
        span: Span,
    },
}

impl TestItem {
    pub fn span(&self) -> Span {
        match self {
            Self::Row(row) => row.span,
            Self::Repeat { span, .. } => *span,
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct UntilSyntax {
    pub output: NameSyntax,
    /// 1 if there is none.
    pub value: Option<NameSyntax>,
    pub most: Number,
}

#[derive(Clone, Debug, PartialEq)]
pub struct TestRowSyntax {
    pub inputs: Vec<NameSyntax>,
    /// A valid row has one.
    pub bars: Vec<Span>,
    pub outputs: Vec<NameSyntax>,
    pub hold: Option<Quantity>,
    pub until: Option<UntilSyntax>,
    pub span: Span,
}
