//! The messages for errors of widths, bits and drivers.

use crate::diag::{Code, Diagnostic};
use crate::source::Span;

/// "1 bit", "8 bits".
pub(super) fn bits(width: u64) -> String {
    crate::diag::counted(width as usize, "bit")
}

/// The name of a value in help: that of the net, if it is a net.
#[derive(Clone, Debug)]
pub(super) struct Operand {
    pub(super) width: u32,
    pub(super) span: Span,
    pub(super) net: Option<String>,
}

impl Operand {
    /// How to extend it to a larger width.
    fn widened(&self, to: u32) -> String {
        let net = self.net.as_deref().unwrap_or("…");
        let zeros = format!("`{{{}'d0, {net}}}`", to - self.width);
        match self.width {
            1 => format!("repeat the bit with `{{{to}{{{net}}}}}`, or put zeros before it with {zeros}"),
            _ => format!("put zeros before it with {zeros}"),
        }
    }

    /// How to cut it to a smaller width.
    fn narrowed(&self, to: u32) -> String {
        let bits = if to == 1 { "0".to_owned() } else { format!("{}..0", to.saturating_sub(1)) };
        match &self.net {
            Some(net) => format!("take some of its bits with `{net}[{bits}]`"),
            None => format!("name the value, `t = …`, and take some of its bits with `t[{bits}]`"),
        }
    }
}

/// An unexpected width.
pub(super) fn width(what: &str, expected: u32, found: &Operand) -> Diagnostic {
    let message = format!("{what} is {} wide, expected {}", bits(found.width.into()), bits(expected.into()));
    let help = if found.width > expected { found.narrowed(expected) } else { found.widened(expected) };
    Diagnostic::new(Code::Width, message, found.span, bits(found.width.into())).with_help(help)
}

/// Two operands of different widths.
pub(super) fn operands(what: &str, first: &Operand, second: &Operand) -> Diagnostic {
    let message = format!("{what} of {} and of {}", bits(first.width.into()), bits(second.width.into()));
    let (narrow, wide) = if first.width < second.width { (first, second) } else { (second, first) };
    let help = match narrow.width {
        1 => narrow.widened(wide.width),
        _ => format!(
            "{}, or {}",
            narrow.widened(wide.width),
            wide.narrowed(narrow.width).replace("its bits", "the other's bits")
        ),
    };
    Diagnostic::new(Code::Width, message, second.span, bits(second.width.into()))
        .with_label(first.span, bits(first.width.into()))
        .with_help(help)
}

/// A number outside its range.
pub(super) fn range(message: String, span: Span, label: String) -> Diagnostic {
    Diagnostic::new(Code::OutOfRange, message, span, label)
}

/// A width that cannot be inferred.
pub(super) fn unknown_width(name: &str, span: Span) -> Diagnostic {
    let message = format!("the width of `{name}` cannot be told");
    Diagnostic::new(Code::UnknownWidth, message, span, "this net").with_help(format!("declare it: `net {name}[8]`"))
}
