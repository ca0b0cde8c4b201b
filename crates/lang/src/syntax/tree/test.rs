//! Simulations and tests, as written.

use nbc_base::source::Span;

use crate::syntax::tree::{BodySyntax, InstanceSyntax, NameSyntax, Number, Quantity, SpellSyntax, Text};

/// `simulate latch with …`
#[derive(Clone, Debug, PartialEq)]
pub struct Simulate {
    /// The name of the swarm to simulate.
    pub swarm: NameSyntax,
    /// The world after `in`, if it is given: `in slippery`.
    pub world: Option<NameSyntax>,
    /// The inputs of the swarm over time.
    pub with: With,
}

/// The inputs of a simulation over time.
#[derive(Clone, Debug, PartialEq)]
pub enum With {
    /// `with sweep`
    Named(NameSyntax),
    /// `with schedule (d, e) { … }`
    Spells {
        /// The input ports.
        columns: Vec<NameSyntax>,
        /// The spells in order of time.
        spells: Vec<SpellSyntax>,
    },
}

/// `test latch "…" …`
#[derive(Clone, Debug, PartialEq)]
pub struct Test {
    /// The circuit to test, with values for its parameters.
    pub circuit: InstanceSyntax,
    /// The text after the circuit that tells tests apart.
    pub title: Option<Text>,
    /// The environment after `with`, if it is given.
    pub environment: Option<NameSyntax>,
    /// The worlds after `in`: `in slippery` or `in [paper, worn]`.
    pub worlds: Vec<NameSyntax>,
    /// What the circuit must do.
    pub kind: TestKind,
}

/// What a tested circuit must do.
#[derive(Clone, Debug, PartialEq)]
pub enum TestKind {
    /// The rows of a table: inputs and expected outputs.
    Table(TestTable),
    /// `from "rows.csv" at least 93%`
    FromFile {
        /// The file of rows, relative to the folder of the source.
        path: Text,
        /// The share of the rows that must pass, if not all must.
        at_least: Option<Quantity>,
    },
    /// `for all inputs against other`
    Against(InstanceSyntax),
    /// `against other for ever`
    Ever(InstanceSyntax),
    /// `for all inputs { … }`
    Reference(Box<BodySyntax>),
}

/// The rows of a test.
#[derive(Clone, Debug, PartialEq)]
pub struct TestTable {
    /// The names of the columns before the bar.
    pub inputs: Vec<NameSyntax>,
    /// The names of the columns after the bar.
    pub outputs: Vec<NameSyntax>,
    /// The rows in order of time.
    pub rows: Vec<TestItem>,
    /// The place of the header.
    pub header: Span,
}

/// A row of a test, or rows that are repeated.
#[derive(Clone, Debug, PartialEq)]
pub enum TestItem {
    /// One row.
    Row(Box<TestRowSyntax>),
    /// `repeat 32 { … }`
    Repeat {
        /// The number of times.
        times: Number,
        /// What is repeated.
        rows: Vec<TestItem>,
        /// The place, including the braces.
        span: Span,
    },
}

impl TestItem {
    /// The place in the source.
    pub fn span(&self) -> Span {
        match self {
            Self::Row(row) => row.span,
            Self::Repeat { span, .. } => *span,
        }
    }
}

/// `until ready, at most 100 rows`
#[derive(Clone, Debug, PartialEq)]
pub struct UntilSyntax {
    /// The output that ends the repetition.
    pub output: NameSyntax,
    /// The value that it must have; 1 if it is not given.
    pub value: Option<NameSyntax>,
    /// The most rows.
    pub most: Number,
}

/// One row of a test.
#[derive(Clone, Debug, PartialEq)]
pub struct TestRowSyntax {
    /// The values before the bar.
    pub inputs: Vec<NameSyntax>,
    /// The bars; a valid row has one.
    pub bars: Vec<Span>,
    /// The values after the bar.
    pub outputs: Vec<NameSyntax>,
    /// The hold of this row, if it sets one.
    pub hold: Option<Quantity>,
    /// When the repetition of this row ends, if it is repeated.
    pub until: Option<UntilSyntax>,
    /// The place of the row in the source.
    pub span: Span,
}
