//! Diagnostics as data for programs: those of [`Diagnostic`] with file names, lines and columns.

use serde::Serialize;

use super::{Code, Diagnostic, Label, Severity};
use crate::source::{Sources, Span};

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DiagnosticReport {
    /// `nbc explain CODE` tells more.
    code: Code,
    severity: Severity,
    message: String,
    /// What to do about it.
    help: Option<String>,
    /// The places, the main one first.
    labels: Vec<PlaceReport>,
    /// Notes at other places.
    related: Vec<PlaceReport>,
    /// Edits that do what the help says, if they certainly remove the fault.
    fix: Option<FixReport>,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct FixReport {
    /// What the edits do, for a menu.
    title: String,
    /// Replacements that do not overlap, in order of place.
    edits: Vec<PlaceReport>,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct PlaceReport {
    /// What is said of the place; in an edit, the text to write there.
    text: String,
    file: String,
    start: PositionReport,
    /// One past the last character.
    end: PositionReport,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct PositionReport {
    /// From 0.
    byte: u32,
    /// From 1.
    line: usize,
    /// From 1, in characters.
    column: usize,
}

/// All diagnostics in their order.
pub fn json(diagnostics: &[Diagnostic], sources: &Sources) -> Vec<DiagnosticReport> {
    diagnostics.iter().map(|diagnostic| DiagnosticReport::of(diagnostic, sources)).collect()
}

impl DiagnosticReport {
    fn of(diagnostic: &Diagnostic, sources: &Sources) -> Self {
        let place = |span: Span, text: &str| PlaceReport::of(span, text, sources);
        let places = |labels: &[Label]| labels.iter().map(|label| place(label.span, &label.text)).collect();
        Self {
            code: diagnostic.code,
            severity: diagnostic.severity,
            message: diagnostic.message.clone(),
            help: diagnostic.help.clone(),
            labels: places(&diagnostic.labels),
            related: places(&diagnostic.related),
            fix: diagnostic.fix.as_ref().map(|fix| FixReport {
                title: fix.title.clone(),
                edits: fix.edits.iter().map(|edit| place(edit.span, &edit.text)).collect(),
            }),
        }
    }
}

impl PlaceReport {
    fn of(span: Span, text: &str, sources: &Sources) -> Self {
        let file = sources.file(span.file);
        let end = |byte: u32| {
            let place = file.line_column(byte as usize);
            PositionReport { byte, line: place.line, column: place.column }
        };
        Self { text: text.to_owned(), file: file.name.clone(), start: end(span.start), end: end(span.end) }
    }
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json as value};

    use super::*;
    use crate::diag::Fix;

    #[test]
    fn places_have_bytes_lines_and_columns() {
        let mut sources = Sources::default();
        let file = sources.add("a.nb", "circuit\n  é }\n");
        let diagnostic = Diagnostic::new(Code::Syntax, "unexpected `}`", Span::new(file, 13, 14), "here");
        let written = |one: &Diagnostic| serde_json::to_value(DiagnosticReport::of(one, &sources)).unwrap();
        let first = written(&diagnostic);
        let label = &first["labels"][0];
        assert_eq!(label["start"], value!({ "byte": 13, "line": 2, "column": 5 }));
        assert_eq!(label["end"], value!({ "byte": 14, "line": 2, "column": 6 }));
        assert_eq!(first["fix"], Value::Null);
        let fixed = diagnostic.with_fix(Fix::replace(Span::new(file, 13, 14), "{"));
        let fix = &written(&fixed)["fix"];
        assert_eq!((&fix["title"], &fix["edits"][0]["text"]), (&value!("replace with `{`"), &value!("{")));
        assert_eq!(fix["edits"][0]["start"], label["start"]);
    }
}
