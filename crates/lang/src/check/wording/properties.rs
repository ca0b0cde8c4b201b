//! Properties of all steps.

use nbc_base::diag::{Code, Diagnostic, Fix};
use nbc_base::model::PropertyKind;
use nbc_base::source::Span;

/// An invalid property.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum PropertyError {
    /// Nothing but assumptions.
    NothingToProve { circuit: String },
    /// `never a => b`, with the texts of both.
    NeverImplies { condition: String, value: String, whole: Span },
    /// `within` after a word that it does not go with.
    Within { kind: PropertyKind },
    /// A number of steps that is 0 or too large.
    Steps { text: String, most: u64 },
    /// A call of `before` with other than one operand, or with a name for it.
    OperandsOfBefore { found: usize },
}

impl PropertyError {
    /// The error at the property, the number or the name.
    pub(crate) fn at(self, span: Span) -> Diagnostic {
        match self {
            Self::NothingToProve { circuit } => {
                let message = format!("nothing is said of `{circuit}`");
                Diagnostic::new(Code::Empty, message, span, "expected a line with `always` or `never`")
                    .with_help("for example `never a and b`; `assume` alone proves nothing")
            }
            Self::NeverImplies { condition, value, whole } => {
                let fixed = format!("never {condition} and {value}");
                let message = "`never` has no condition";
                Diagnostic::new(Code::Property, message, span, "expected `always` before a condition and `=>`")
                    .with_help(format!("if both must not be 1 in one step, write `{fixed}`"))
                    .with_fix(Fix::replace(whole, fixed))
            }
            Self::Within { kind } => {
                let message = format!("`{}` has no `within`", kind.word());
                Diagnostic::new(Code::Property, message, span, "expected `always` for what happens within some steps")
                    .with_help("for example `always request => answer within 8 steps`")
            }
            Self::Steps { text, most } => {
                let message = format!("`{text}` is no number of steps here");
                Diagnostic::new(Code::OutOfRange, message, span, format!("expected a number from 1 to {most}"))
                    .with_help("without `within`, a property holds in the same step")
            }
            Self::OperandsOfBefore { found } => {
                let label = format!("found {}", if found == 1 { "a name".to_owned() } else { found.to_string() });
                Diagnostic::new(Code::Operands, "`before` takes one operand", span, label)
                    .with_help("`before(a)` is `a` as it was in the step before")
            }
        }
    }
}
