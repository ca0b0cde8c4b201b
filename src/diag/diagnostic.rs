//! The one diagnostic type that every stage reports with.

use serde::Serialize;

use super::suggest::{Suggestion, alternatives};
use super::{Code, Fix};
use crate::source::Span;

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// Legal, and surely not meant.
    Warning,
    /// The program has no meaning.
    Error,
}

/// A place with a word about it.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Label {
    /// The place.
    pub span: Span,
    /// What is to be said of it; lower case, without a full stop.
    pub text: String,
}

/// A further remark, at a place of its own file.
pub type Related = Label;

/// One fault of the user's input: what, where, and what to do about it. [`super::json`] is its one form for programs.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Diagnostic {
    /// Which rule.
    pub code: Code,
    /// How bad.
    pub severity: Severity,
    /// One line, lower case, without a full stop, the user's words in backticks.
    pub message: String,
    /// The places, the main one first.
    pub labels: Vec<Label>,
    /// What to write instead, where it can be said.
    pub help: Option<String>,
    /// Remarks elsewhere, such as the first of two definitions.
    pub related: Vec<Related>,
    /// Edits that remove the fault, where they are certain to.
    pub fix: Option<Fix>,
}

impl Diagnostic {
    /// A diagnostic of a code's own severity with one labeled place.
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

    /// A diagnostic about a whole file or the command line, with no place in a text.
    pub fn without_place(code: Code, message: impl Into<String>) -> Self {
        let message = message.into();
        let severity = code.severity();
        Self { code, severity, message, labels: Vec::new(), help: None, related: Vec::new(), fix: None }
    }

    /// Adds what to write instead.
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Adds edits that remove the fault.
    pub fn with_fix(mut self, fix: impl Into<Option<Fix>>) -> Self {
        self.fix = fix.into();
        self
    }

    /// Adds the names that may have been meant by the one at `span`; a near one can be put in its place.
    pub fn with_suggestion(self, span: Span, suggestion: &Suggestion) -> Self {
        match suggestion {
            Suggestion::None => self,
            Suggestion::Near(name) => {
                self.with_help(format!("did you mean `{name}`?")).with_fix(Fix::replace(span, name.as_str()))
            }
            Suggestion::Known(names) => self.with_help(format!("known here: {}", alternatives(names, "and"))),
        }
    }

    /// Adds a further labeled place.
    pub fn with_label(mut self, span: Span, text: impl Into<String>) -> Self {
        self.labels.push(Label { span, text: text.into() });
        self
    }

    /// Adds a remark at another place.
    pub fn with_related(mut self, span: Span, text: impl Into<String>) -> Self {
        self.related.push(Label { span, text: text.into() });
        self
    }

    /// Whether it is an error.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }
}
