//! Messages about rows of a file.

use nbc_base::budget::Limit;
use nbc_base::diag::{Code, Diagnostic, Suggestion, counted};
use nbc_base::source::Span;

pub(super) const MOST_ERRORS: usize = 20;

const LIMIT: &str = "the limit is reached here";

fn value(message: &str, at: Span, label: &str) -> Diagnostic {
    Diagnostic::new(Code::Value, message, at, label)
}

fn too_large(message: String, at: Span, label: impl Into<String>) -> Diagnostic {
    Diagnostic::new(Code::TooLarge, message, at, label)
}

fn beginning(span: Span) -> Span {
    Span { end: span.end.min(span.start + 20), ..span }
}

pub(super) fn empty(at: Span) -> Diagnostic {
    Diagnostic::new(Code::Empty, "file has no columns", at, "expected names of columns between commas")
}

pub(super) fn no_header(at: Span) -> Diagnostic {
    value("file has no names of columns", at, "expected the names of ports before the first row")
        .with_help("write a first line such as `a,b,q`")
}

pub(super) fn no_rows(at: Span) -> Diagnostic {
    Diagnostic::new(Code::Empty, "file has no rows", at, "expected a line of values after the names")
}

pub(super) fn unnamed(at: Span) -> Diagnostic {
    value("column has no name", at, "expected the name of a port, such as `a` or `a[0]`")
}

pub(super) fn long_name(bytes: usize, at: Span) -> Diagnostic {
    let label = format!("expected at most {}", Limit::FileNameBytes.most());
    too_large(format!("name of {bytes} bytes is too long"), beginning(at), label)
}

pub(super) fn twice(name: &str, first: Span, at: Span) -> Diagnostic {
    Diagnostic::new(Code::Duplicate, format!("column `{name}` is there twice"), at, "again here")
        .with_related(first, "first here")
}

pub(super) fn row_width(values: usize, columns: usize, at: Span) -> Diagnostic {
    let message = format!("row has {} for {}", counted(values, "value"), counted(columns, "column"));
    Diagnostic::new(Code::RowWidth, message, at, "expected a value for each column")
}

pub(super) fn not_a_number(word: &str, column: &str, at: Span) -> Diagnostic {
    let label = "expected a whole number such as 5 or 0x1f, or `-` for any";
    value(&format!("`{word}` is not a value of `{column}`"), beginning(at), label)
}

pub(super) fn wide_value(column: &str, bits: usize, at: Span) -> Diagnostic {
    let label = format!("expected at most {}, four for each hexadecimal digit", Limit::Width.most());
    too_large(format!("value of `{column}` has {bits} bits"), beginning(at), label)
}

pub(super) fn too_many_rows(at: Span) -> Diagnostic {
    too_large(format!("file has more than {} rows", Limit::Rows.most()), at, LIMIT)
}

pub(super) fn too_many_bits(at: Span) -> Diagnostic {
    too_large(format!("the rows of the file have more than {} bits", Limit::RowBits.most()), at, LIMIT)
}

pub(super) fn open_inputs(open: usize, at: Span) -> Diagnostic {
    let label = format!("expected at most {}, because all of their values are rows", Limit::TriedBits.most());
    too_large(format!("row leaves {} open", counted(open, "input")), at, label)
}

pub(super) fn ones_only(inputs: usize, at: Span) -> Diagnostic {
    let message = format!("a PLA of this type describes all rows of {}", counted(inputs, "input"));
    let label = format!("expected at most {} inputs, or the type `fr` or `fdr`", Limit::TriedBits.most());
    too_large(message, at, label)
}

pub(super) fn no_port(column: &str, circuit: &str, meant: &Suggestion, at: Span) -> Diagnostic {
    let message = format!("`{circuit}` has no port for the column `{column}`");
    Diagnostic::new(Code::Unknown, message, at, "expected the name of a port or of a bit of one")
        .with_suggestion(None, meant)
}

pub(super) fn no_column(port: &str, circuit: &str, at: Span) -> Diagnostic {
    let message = format!("file has no column for `{port}` of `{circuit}`");
    Diagnostic::new(Code::RowWidth, message, at, "expected it among these columns")
        .with_help(format!("name a column `{port}`, or columns for each of its bits, such as `{port}[0]`"))
}

pub(super) fn bit_and_port(port: &str, at: Span) -> Diagnostic {
    let label = "expected either the port or all of its bits";
    Diagnostic::new(Code::Duplicate, format!("columns have `{port}` and its bits"), at, label)
}

pub(super) fn unfitting(port: &str, width: usize, at: Span) -> Diagnostic {
    let label = format!("expected a value of {}", counted(width, "bit"));
    Diagnostic::new(Code::OutOfRange, format!("row has a value that does not fit into `{port}`"), at, label)
}

pub(super) fn open_input(port: &str, at: Span) -> Diagnostic {
    value(&format!("row has no value for the input `{port}`"), at, "expected a value in each column of an input")
}

pub(super) fn no_inputs(at: Span) -> Diagnostic {
    value("no column is an input", at, "expected a column of an input, too")
}

pub(super) fn no_output(output: &str, meant: &Suggestion) -> Diagnostic {
    let message = format!("the file has no columns for the output `{output}`");
    Diagnostic::without_place(Code::Unknown, message).with_suggestion(None, meant)
}
