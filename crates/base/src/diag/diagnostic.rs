//! The diagnostic type that every stage reports.

use super::suggest::{Suggestion, alternatives};
use super::{Code, Fix, Severity};
use crate::source::Span;

/// A place with a word about it.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Label {
    pub span: Span,
    /// The text of the label; lower case, without a full stop. It may be empty.
    pub text: String,
}

/// A related note with a place in its own file.
pub type Related = Label;

/// One fault of the user's input: what is wrong, where, and what to do about it.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Diagnostic {
    pub code: Code,
    /// Whether the input is refused, or only suspect; mostly that of the code.
    pub severity: Severity,
    /// One line, lower case, without a full stop, with the user's text in backticks.
    pub message: String,
    /// The places, the main one first.
    pub labels: Vec<Label>,
    pub help: Option<String>,
    /// Related places, such as the first of two definitions.
    pub related: Vec<Related>,
    /// Edits that certainly remove the fault, if there are any.
    pub fix: Option<Fix>,
}

impl Diagnostic {
    /// A diagnostic with its code's own severity and one labeled place.
    pub fn new(code: Code, message: impl Into<String>, span: Span, label: impl Into<String>) -> Self {
        Self {
            code,
            severity: code.severity(),
            message: message.into(),
            labels: vec![Label { span, text: label.into() }],
            help: None,
            related: Vec::new(),
            fix: None,
        }
    }

    /// A diagnostic about a whole file or the command line, without a place in a text.
    pub fn without_place(code: Code, message: impl Into<String>) -> Self {
        let message = message.into();
        let severity = code.severity();
        Self { code, severity, message, labels: Vec::new(), help: None, related: Vec::new(), fix: None }
    }

    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    pub fn with_fix(mut self, fix: impl Into<Option<Fix>>) -> Self {
        self.fix = fix.into();
        self
    }

    /// Adds the names that may have been meant by the one at a place; a near one can be written there.
    pub fn with_suggestion(self, place: impl Into<Option<Span>>, suggestion: &Suggestion) -> Self {
        match suggestion {
            Suggestion::None => self,
            Suggestion::Near(name) => {
                let fix = place.into().map(|span| Fix::replace(span, name.as_str()));
                self.with_help(format!("did you mean `{name}`?")).with_fix(fix)
            }
            Suggestion::Known(names) => self.with_help(format!("known here: {}", alternatives(names, "and"))),
        }
    }

    /// Replaces the help by the near name, if there is one.
    pub fn with_near(self, suggestion: &Suggestion) -> Self {
        if let Suggestion::Near(_) = suggestion { self.with_suggestion(None, suggestion) } else { self }
    }

    pub fn with_label(mut self, span: Span, text: impl Into<String>) -> Self {
        self.labels.push(Label { span, text: text.into() });
        self
    }

    pub fn with_related(mut self, span: Span, text: impl Into<String>) -> Self {
        self.related.push(Label { span, text: text.into() });
        self
    }

    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }
}
