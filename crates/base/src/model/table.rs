//! Truth tables: exactly one row for every pattern.

use crate::source::Span;

#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// In the order of the source. No two patterns match the same inputs.
    pub rows: Vec<TableRow>,
    pub otherwise: Option<TableOutput>,
    pub span: Span,
}

impl Table {
    pub fn outputs(&self) -> impl Iterator<Item = &TableOutput> {
        self.rows.iter().map(|row| &row.output).chain(&self.otherwise)
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct TableRow {
    pub pattern: TablePattern,
    pub span: Span,
    pub output: TableOutput,
}

#[derive(Clone, Debug, PartialEq)]
pub enum TablePattern {
    /// Most significant bit first; `None` matches both values.
    Bits(Vec<Option<bool>>),
    Number(u128),
}

#[derive(Clone, Debug, PartialEq)]
pub struct TableOutput {
    pub value: OutputValue,
    pub span: Span,
}

#[derive(Clone, Debug, PartialEq)]
pub enum OutputValue {
    /// Most significant bit first; the compiler chooses a bit that is `None`.
    Bits(Vec<Option<bool>>),
    Number(u128),
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
    pub fn bits(&self) -> &[Option<bool>] {
        match &self.pattern {
            TablePattern::Bits(bits) => bits,
            TablePattern::Number(_) => &[],
        }
    }
}
