//! How work that would make too much is reported.

use super::OverBudget;
use crate::diag::{Code, Diagnostic};
use crate::source::Span;

impl OverBudget {
    pub fn at(self, span: Span) -> Diagnostic {
        Diagnostic::new(Code::TooLarge, self.message(), span, "the limit is reached here")
    }

    pub fn without_place(self) -> Diagnostic {
        Diagnostic::without_place(Code::TooLarge, self.message())
    }

    fn message(self) -> String {
        match self {
            Self::Limit(limit) => format!("the program needs more than {} {}", limit.most(), limit.things()),
            Self::Cancelled => "the check was cancelled".to_owned(),
        }
    }
}
