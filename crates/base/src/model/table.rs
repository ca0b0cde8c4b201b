//! Truth tables: exactly one row for every pattern.

use crate::source::Span;

/// A truth table as written.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// In the order of the source. No two patterns match the same inputs.
    pub rows: Vec<TableRow>,
    /// The output for the patterns without a row.
    pub otherwise: Option<TableOutput>,
    /// The place of the table.
    pub span: Span,
}

impl Table {
    /// The output of each row, and then the one of the other patterns.
    pub fn outputs(&self) -> impl Iterator<Item = &TableOutput> {
        self.rows.iter().map(|row| &row.output).chain(&self.otherwise)
    }
}

/// One row of a truth table.
#[derive(Clone, Debug, PartialEq)]
pub struct TableRow {
    /// The inputs that it is for.
    pub pattern: TablePattern,
    /// The place of the pattern.
    pub span: Span,
    /// What the table shows for these inputs.
    pub output: TableOutput,
}

/// The inputs that a row of a truth table is for.
#[derive(Clone, Debug, PartialEq)]
pub enum TablePattern {
    /// Most significant bit first; `None` matches both values.
    Bits(Vec<Option<bool>>),
    /// All inputs together, as a number.
    Number(u128),
}

/// The output of a row.
#[derive(Clone, Debug, PartialEq)]
pub struct TableOutput {
    /// One bit for each output, or a value that is computed.
    pub value: OutputValue,
    /// The place of the output in the source.
    pub span: Span,
}

/// The value of an output.
#[derive(Clone, Debug, PartialEq)]
pub enum OutputValue {
    /// Most significant bit first; the compiler chooses a bit that is `None`.
    Bits(Vec<Option<bool>>),
    /// A number as wide as the other outputs.
    Number(u128),
    /// This one of the expressions of the table.
    Expression(usize),
}

impl Table {
    /// Whether every pattern has its bits, so that it is known without the inputs what is wrong.
    pub fn is_in_bits(&self) -> bool {
        self.rows.iter().all(|row| matches!(row.pattern, TablePattern::Bits(_)))
    }
}

impl TablePattern {
    /// The number that a single digit stands for; it is a bit, too.
    pub fn digit(&self) -> Option<u128> {
        match self {
            Self::Bits(bits) if bits.len() == 1 => bits[0].map(u128::from),
            _ => None,
        }
    }
}

impl TableRow {
    /// The bits of the pattern, the most significant first; none of a number.
    pub fn bits(&self) -> &[Option<bool>] {
        match &self.pattern {
            TablePattern::Bits(bits) => bits,
            TablePattern::Number(_) => &[],
        }
    }
}
