//! Messages about truth tables that are not functions.

use nbc_base::budget::Limit;
use nbc_base::diag::{Code, Diagnostic, Edit, Fix, Suggestion, counted};
use nbc_base::source::Span;

pub fn not_a_pattern(word: &str, meant: &Suggestion, at: Span) -> Diagnostic {
    let message = format!("`{word}` is not a pattern");
    Diagnostic::new(Code::Syntax, message, at, "expected `0`, `1` and `-`, a number or a member")
        .with_suggestion(at, meant)
}

pub fn wide_number(value: u128, width: usize, at: Span) -> Diagnostic {
    let message = format!("{value} does not fit into {}", counted(width, "bit"));
    Diagnostic::new(Code::OutOfRange, message, at, "the width of the inputs of the table")
}

pub fn too_many_rows(rows: usize, at: Span) -> Diagnostic {
    let label = format!("expected at most {}", Limit::TableRows.most());
    Diagnostic::new(Code::TooLarge, format!("a table of {rows} rows is too large"), at, label)
}

pub fn too_many_bits(bits: usize, at: Span) -> Diagnostic {
    let label = format!("expected at most {}", Limit::TableBits.most());
    Diagnostic::new(Code::TooLarge, format!("a pattern of {bits} bits is too wide"), at, label)
}

pub fn uneven(what: &str, before: (usize, Span), here: (usize, Span)) -> Diagnostic {
    let message = format!("the {what} of a table differ in width");
    Diagnostic::new(Code::RowWidth, message, here.1, counted(here.0, "bit"))
        .with_label(before.1, counted(before.0, "bit"))
}

pub fn two_else(first: Span, at: Span) -> Diagnostic {
    Diagnostic::new(Code::TableOverlap, "the table has two `else` rows", at, "and this row")
        .with_label(first, "this row")
}

pub fn overlap(first: Span, at: Span) -> Diagnostic {
    Diagnostic::new(Code::TableOverlap, "two rows of the table match the same pattern", at, "and this row")
        .with_label(first, "this row")
        .with_help("remove one of them, or write `0` or `1` for `-`")
}

/// No row for a pattern; `rest` is a row for all remaining patterns, and the byte at which it would follow the others.
pub fn missing_row(pattern: &str, rest: Option<(u32, String)>, at: Span) -> Diagnostic {
    let fix = rest.map(|(end, row)| Fix {
        title: format!("add `{row}`"),
        edits: vec![Edit { span: Span { start: end, end, ..at }, text: format!(", {row}") }],
    });
    incomplete(format!("the table has no row for `{pattern}`"), at).with_fix(fix)
}

pub fn no_rows(at: Span) -> Diagnostic {
    incomplete("the table has no rows".to_owned(), at)
}

fn incomplete(message: String, at: Span) -> Diagnostic {
    Diagnostic::new(Code::TableIncomplete, message, at, "in this table")
        .with_help("add the row, or `else: 0` for all remaining patterns")
}
