//! Properties of all steps.

use nbc_base::diag::{Code, Diagnostic, Fix};
use nbc_base::model::PropertyKind;
use nbc_base::source::Span;

pub(crate) fn nothing_to_prove(circuit: &str, at: Span) -> Diagnostic {
    let message = format!("nothing is said of `{circuit}`");
    Diagnostic::new(Code::Empty, message, at, "expected a line with `always` or `never`")
        .with_help("for example `never a and b`; `assume` alone proves nothing")
}

/// `never a => b`; `whole` covers it.
pub(crate) fn never_implies(condition: &str, value: &str, whole: Span, at: Span) -> Diagnostic {
    let fixed = format!("never {condition} and {value}");
    Diagnostic::new(Code::Property, "`never` has no condition", at, "expected `always` before a condition and `=>`")
        .with_help(format!("if both must not be 1 in one step, write `{fixed}`"))
        .with_fix(Fix::replace(whole, fixed))
}

pub(crate) fn unexpected_within(kind: PropertyKind, at: Span) -> Diagnostic {
    let message = format!("`{}` has no `within`", kind.word());
    Diagnostic::new(Code::Property, message, at, "expected `always` for what happens within some steps")
        .with_help("for example `always request => answer within 8 steps`")
}

pub(crate) fn steps_within(text: &str, most: u64, at: Span) -> Diagnostic {
    let message = format!("`{text}` is no number of steps here");
    Diagnostic::new(Code::OutOfRange, message, at, format!("expected a number from 1 to {most}"))
        .with_help("without `within`, a property holds in the same step")
}

pub(crate) fn operands_of_before(found: Option<usize>, at: Span) -> Diagnostic {
    let found = found.map_or("a name".to_owned(), |found| found.to_string());
    Diagnostic::new(Code::Operands, "`before` takes one operand", at, format!("found {found}"))
        .with_help("`before(a)` is `a` as it was in the step before")
}
