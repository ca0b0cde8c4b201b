//! Fixes: edits of the source that remove a fault, for editors to offer.

use crate::source::{FileId, Span};

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Edit {
    /// What is replaced; empty where text is inserted.
    pub span: Span,
    pub text: String,
}

/// Edits that do what the help of a diagnostic says. They do not overlap.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Fix {
    /// What the edits do, as an editor shows it; lower case, without a full stop.
    pub title: String,
    pub edits: Vec<Edit>,
}

impl Fix {
    pub fn replace(span: Span, text: impl Into<String>) -> Self {
        let text = text.into();
        Self { title: format!("replace with `{}`", text.trim()), edits: vec![Edit { span, text }] }
    }

    pub fn insert(span: Span, text: impl Into<String>) -> Self {
        let text = text.into();
        let span = Span { end: span.start, ..span };
        Self { title: format!("insert `{}`", text.trim()), edits: vec![Edit { span, text }] }
    }

    pub fn remove(span: Span, what: &str) -> Self {
        Self { title: format!("remove {what}"), edits: vec![Edit { span, text: String::new() }] }
    }

    pub fn apply(&self, file: FileId, text: &str) -> String {
        let mut fixed = text.to_owned();
        for edit in self.edits.iter().rev().filter(|edit| edit.span.file == file) {
            fixed.replace_range(edit.span.range(), &edit.text);
        }
        fixed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edits_are_applied_in_their_places() {
        const FILE: FileId = FileId(0);
        let span = |start, end| Span::new(FILE, start, end);
        assert_eq!(Fix::replace(span(4, 5), "and").apply(FILE, "q = &"), "q = and");
        assert_eq!(Fix::insert(span(1, 1), ",").apply(FILE, "a b"), "a, b");
        assert_eq!(Fix::remove(span(1, 2), "the space").apply(FILE, "f (a)"), "f(a)");
        let edits = [Fix::replace(span(0, 1), "\""), Fix::replace(span(2, 3), "\"")].map(|fix| fix.edits).concat();
        assert_eq!(Fix { title: String::new(), edits }.apply(FILE, "'x'"), "\"x\"");
    }
}
