//! Truth tables that are not functions.

use nbc_base::diag::{Code, Diagnostic, Edit, Fix, Suggestion, counted};
use nbc_base::source::Span;

/// A truth table that is not a function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TableError {
    /// A pattern with anything but `0`, `1` and `-`.
    NotAPattern {
        /// The pattern as written.
        word: String,
        /// The member that may be meant.
        meant: Suggestion,
    },
    /// A number that does not fit into the inputs.
    WideNumber {
        /// The number.
        value: u128,
        /// The width of the inputs in bits.
        width: usize,
    },
    /// A table with too many rows.
    TooManyRows {
        /// The number of rows.
        rows: usize,
        /// The most that are possible.
        most: u64,
    },
    /// A pattern of too many bits.
    TooManyBits {
        /// The number of bits; of two places, that of the first one first.
        bits: usize,
        /// The most that are possible.
        most: u64,
    },
    /// Patterns or outputs of different widths.
    Uneven {
        /// What differs.
        what: &'static str,
        /// The number of bits; of two places, that of the first one first.
        bits: [usize; 2],
        /// The other place.
        first: Span,
    },
    /// A second `else`.
    TwoElse {
        /// The other place.
        first: Span,
    },
    /// Two rows for one pattern.
    Overlap {
        /// The other place.
        first: Span,
    },
    /// No row for a pattern; `rest` is a row for all remaining patterns, and the byte at which it would follow the
    /// others.
    MissingRow {
        /// A pattern without a row.
        pattern: String,
        /// A row for all such patterns, and where it is to be added.
        rest: Option<(u32, String)>,
    },
    /// No rows at all.
    Empty,
}

impl TableError {
    /// The error at the table, the row or the pattern.
    pub fn at(self, span: Span) -> Diagnostic {
        match self {
            Self::NotAPattern { word, meant } => {
                let message = format!("`{word}` is not a pattern");
                Diagnostic::new(Code::Syntax, message, span, "expected `0`, `1` and `-`, a number or a member")
                    .with_suggestion(span, &meant)
            }
            Self::WideNumber { value, width } => {
                let message = format!("{value} does not fit into {}", counted(width, "bit"));
                Diagnostic::new(Code::OutOfRange, message, span, "the width of the inputs of the table")
            }
            Self::TooManyRows { rows, most } => {
                let message = format!("a table of {rows} rows is too large");
                Diagnostic::new(Code::TooLarge, message, span, format!("expected at most {most}"))
            }
            Self::TooManyBits { bits, most } => {
                let message = format!("a pattern of {bits} bits is too wide");
                Diagnostic::new(Code::TooLarge, message, span, format!("expected at most {most}"))
            }
            Self::Uneven { what, bits: [before, here], first } => {
                let message = format!("the {what} of a table differ in width");
                Diagnostic::new(Code::RowWidth, message, span, counted(here, "bit"))
                    .with_label(first, counted(before, "bit"))
            }
            Self::TwoElse { first } => {
                Diagnostic::new(Code::TableOverlap, "the table has two `else` rows", span, "and this row")
                    .with_label(first, "this row")
            }
            Self::Overlap { first } => {
                let message = "two rows of the table match the same pattern";
                Diagnostic::new(Code::TableOverlap, message, span, "and this row")
                    .with_label(first, "this row")
                    .with_help("remove one of them, or write `0` or `1` for `-`")
            }
            Self::MissingRow { pattern, rest } => {
                let fix = rest.map(|(end, row)| Fix {
                    title: format!("add `{row}`"),
                    edits: vec![Edit { span: Span { start: end, end, ..span }, text: format!(", {row}") }],
                });
                missing_row(format!("the table has no row for `{pattern}`"), span).with_fix(fix)
            }
            Self::Empty => missing_row("the table has no rows".to_owned(), span),
        }
    }
}

fn missing_row(message: String, span: Span) -> Diagnostic {
    Diagnostic::new(Code::TableIncomplete, message, span, "in this table")
        .with_help("add the row, or `else: 0` for all remaining patterns")
}
