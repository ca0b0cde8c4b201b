//! Diagnostics as JSON: the data of [`Diagnostic`] with file names, lines and columns.

use serde_json::{Value, json};

use super::{Diagnostic, Label};
use crate::source::{Sources, Span};

/// All diagnostics in their order, as `docs/schema/diagnostics.json` describes them: a place is `file`, `start` and
/// `end`, each with its byte from 0, and its line and column from 1.
pub fn json(diagnostics: &[Diagnostic], sources: &Sources) -> Vec<Value> {
    diagnostics.iter().map(|diagnostic| one(diagnostic, sources)).collect()
}

fn one(diagnostic: &Diagnostic, sources: &Sources) -> Value {
    let places =
        |labels: &[Label]| -> Value { labels.iter().map(|label| place(label.span, &label.text, sources)).collect() };
    json!({
        "code": diagnostic.code,
        "severity": diagnostic.severity,
        "message": diagnostic.message,
        "help": diagnostic.help,
        "labels": places(&diagnostic.labels),
        "related": places(&diagnostic.related),
        "fix": diagnostic.fix.as_ref().map(|fix| {
            let edits: Value = fix.edits.iter().map(|edit| place(edit.span, &edit.text, sources)).collect();
            json!({ "title": fix.title, "edits": edits })
        }),
    })
}

/// A place with a text: its label, or its replacement.
fn place(span: Span, text: &str, sources: &Sources) -> Value {
    let file = sources.file(span.file);
    let end = |byte: u32| {
        let place = file.line_column(byte as usize);
        json!({ "byte": byte, "line": place.line, "column": place.column })
    };
    json!({ "text": text, "file": file.name, "start": end(span.start), "end": end(span.end) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diag::{Code, Fix};

    #[test]
    fn places_have_bytes_lines_and_columns() {
        let mut sources = Sources::default();
        let file = sources.add("a.nb", "circuit\n  é }\n");
        let diagnostic = Diagnostic::new(Code::Syntax, "unexpected `}`", Span::new(file, 13, 14), "here");
        let written = json(&[diagnostic.clone()], &sources).remove(0);
        let label = &written["labels"][0];
        assert_eq!(label["start"], json!({ "byte": 13, "line": 2, "column": 5 }));
        assert_eq!(label["end"], json!({ "byte": 14, "line": 2, "column": 6 }));
        assert_eq!(written["fix"], Value::Null);
        let fixed = diagnostic.with_fix(Fix::replace(Span::new(file, 13, 14), "{"));
        let fix = &json(&[fixed], &sources)[0]["fix"];
        assert_eq!((&fix["title"], &fix["edits"][0]["text"]), (&json!("replace with `{`"), &json!("{")));
        assert_eq!(fix["edits"][0]["start"], label["start"]);
    }
}
