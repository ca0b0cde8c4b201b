//! Diagnostics for programs and pages.

use serde::Serialize;

use super::{Code, Diagnostic, Label, Severity};
use crate::source::{Sources, Span};

/// A diagnostic for programs and pages, with file names, lines and columns.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Finding {
    /// `nbc explain CODE` tells more.
    pub code: Code,
    pub severity: Severity,
    pub message: String,
    /// What to do about it.
    pub help: Option<String>,
    /// The places, the main one first.
    pub labels: Vec<PlacedText>,
    /// Notes at other places.
    pub related: Vec<PlacedText>,
    /// Edits that do what the help says, if they certainly remove the fault.
    pub fix: Option<FoundFix>,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PlacedText {
    pub file: String,
    pub start: TextPlace,
    /// One past the last character.
    pub end: TextPlace,
    /// What is said of the place; in an edit, the text to write there.
    pub text: String,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TextPlace {
    /// From 0.
    pub byte: u32,
    /// From 1.
    pub line: usize,
    /// From 1, in characters.
    pub column: usize,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FoundFix {
    /// What the edits do, for a menu.
    pub title: String,
    /// Replacements that do not overlap, in order of place.
    pub edits: Vec<PlacedText>,
}

pub fn findings(diagnostics: &[Diagnostic], sources: &Sources) -> Vec<Finding> {
    let labels = |labels: &[Label]| labels.iter().map(|label| placed(label.span, &label.text, sources)).collect();
    let finding = |one: &Diagnostic| Finding {
        code: one.code,
        severity: one.severity,
        message: one.message.clone(),
        help: one.help.clone(),
        labels: labels(&one.labels),
        related: labels(&one.related),
        fix: one.fix.as_ref().map(|fix| FoundFix {
            title: fix.title.clone(),
            edits: fix.edits.iter().map(|edit| placed(edit.span, &edit.text, sources)).collect(),
        }),
    };
    diagnostics.iter().map(finding).collect()
}

fn placed(span: Span, text: &str, sources: &Sources) -> PlacedText {
    let file = sources.file(span.file);
    let place = |byte: u32| {
        let place = file.line_column(byte as usize);
        TextPlace { byte, line: place.line, column: place.column }
    };
    PlacedText { file: file.name.clone(), start: place(span.start), end: place(span.end), text: text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diag::Fix;

    #[test]
    fn places_have_bytes_lines_and_columns() {
        let mut sources = Sources::default();
        let file = sources.add("a.nb", "circuit\n  é }\n");
        let diagnostic = Diagnostic::new(Code::Syntax, "unexpected `}`", Span::new(file, 13, 14), "here");
        let found = findings(std::slice::from_ref(&diagnostic), &sources).remove(0);
        let label = &found.labels[0];
        assert_eq!(label.start, TextPlace { byte: 13, line: 2, column: 5 });
        assert_eq!(label.end, TextPlace { byte: 14, line: 2, column: 6 });
        assert!(found.fix.is_none());
        let fixed = diagnostic.with_fix(Fix::replace(Span::new(file, 13, 14), "{"));
        let fix = findings(&[fixed], &sources).remove(0).fix.unwrap();
        assert_eq!((&*fix.title, &*fix.edits[0].text), ("replace with `{`", "{"));
        assert_eq!(fix.edits[0].start, label.start);
    }
}
