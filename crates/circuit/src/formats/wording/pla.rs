//! Messages about PLA files.

use crate::formats::wording::text::damaged;
use nbc_base::diag::{Diagnostic, Severity, counted};
use nbc_base::source::Span;

pub fn no_widths(at: Span) -> Diagnostic {
    let message = "the numbers of inputs and outputs are missing in this PLA file";
    damaged(message, at, "expected lines such as `.i 4` and `.o 1` before this")
}

pub fn no_count(directive: &str, at: Span) -> Diagnostic {
    damaged(format!("`{directive}` has no number of ports"), at, "expected a number of at least 1")
}

pub fn unknown_directive(directive: &str, at: Span) -> Diagnostic {
    let label = "expected .i, .o, .ilb, .ob, .p, .type, .e or a row";
    damaged(format!("unknown PLA directive `{directive}`"), at, label)
}

pub fn unknown_type(found: &str, at: Span) -> Diagnostic {
    damaged(format!("unknown type `{found}` of a PLA"), at, "expected f, fd, fr or fdr")
}

pub fn port_names(expected: usize, found: usize, at: Span) -> Diagnostic {
    let message = format!("{} for {}", counted(found, "name"), counted(expected, "port"));
    damaged(message, at, "expected a name for each port")
}

pub fn cube_width(inputs: usize, outputs: usize, found: usize, at: Span) -> Diagnostic {
    let (wanted, found) = (counted(inputs, "digit"), counted(found, "digit"));
    let label = format!("expected {wanted} of inputs and {outputs} of outputs, found {found}");
    damaged("row has the wrong width", at, label)
}

pub fn input_digit(found: u8, at: Span) -> Diagnostic {
    damaged(format!("`{}` is not a digit of an input", char::from(found)), at, "expected `0`, `1` or `-`")
}

pub fn output_digit(found: u8, at: Span) -> Diagnostic {
    damaged(format!("`{}` is not a digit of an output", char::from(found)), at, "expected `0`, `1`, `-` or `~`")
}

pub fn open_outputs(at: Span) -> Diagnostic {
    let message = "outputs that this PLA leaves open are 0 in the circuit";
    let error = damaged(message, at, "`nbc learn` chooses them so that the circuit is small");
    Diagnostic { severity: Severity::Warning, ..error }
}
