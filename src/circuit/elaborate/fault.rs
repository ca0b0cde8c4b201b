//! The wording of what can be wrong with widths, bits and drivers.

use crate::diag::{Code, Diagnostic};
use crate::source::Span;

/// "1 bit", "8 bits".
pub(super) fn bits(width: u64) -> String {
    format!("{width} bit{}", if width == 1 { "" } else { "s" })
}

/// A width that ought to be another.
pub(super) fn width(what: &str, expected: u32, found: u32, span: Span) -> Diagnostic {
    let message = format!("{what} is {} wide, expected {}", bits(found.into()), bits(expected.into()));
    let fault = Diagnostic::new(Code::Width, message, span, bits(found.into()));
    match (expected, found) {
        (_, 1) => fault.with_help(format!(
            "repeat the bit with `{{{expected}{{a}}}}`, or put zeros before it with `{{{}'d0, a}}`",
            expected - 1
        )),
        _ if found > expected => {
            fault.with_help(format!("take some of its bits with `a[{}..0]`", expected.saturating_sub(1)))
        }
        _ => fault.with_help(format!("put zeros before it with `{{{}'d0, a}}`", expected - found)),
    }
}

/// Two operands that ought to be equally wide.
pub(super) fn operands(what: &str, first: (u32, Span), second: (u32, Span)) -> Diagnostic {
    let message = format!("{what} of {} and of {}", bits(first.0.into()), bits(second.0.into()));
    let narrow = first.0.min(second.0);
    let wide = first.0.max(second.0);
    let help = match narrow {
        1 => format!("repeat the bit: `{{{wide}{{a}}}}`"),
        _ => format!(
            "make them equally wide: `{{{}'d0, a}}` is wider by zeros, `a[{}..0]` narrower",
            wide - narrow,
            narrow.saturating_sub(1)
        ),
    };
    Diagnostic::new(Code::Width, message, second.1, bits(second.0.into()))
        .with_label(first.1, bits(first.0.into()))
        .with_help(help)
}

/// A number outside its range.
pub(super) fn range(message: String, span: Span, label: String) -> Diagnostic {
    Diagnostic::new(Code::OutOfRange, message, span, label)
}

/// A width that nothing tells.
pub(super) fn unknown_width(name: &str, span: Span) -> Diagnostic {
    let message = format!("the width of `{name}` cannot be told");
    Diagnostic::new(Code::UnknownWidth, message, span, "this net").with_help(format!("declare it: `net {name}[8]`"))
}
