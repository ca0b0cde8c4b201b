//! Diagnostics as data for programs: what [`Diagnostic`] holds, with the names of files, lines and columns.

use serde_json::{Value, json};

use super::{Diagnostic, Label};
use crate::source::Sources;

/// All diagnostics in their order: each with `code`, `severity`, `message`, `help`, `labels` and `related`; a place is `file`, `start`
/// and `end` as bytes from 0, and as `line` and `column` from 1.
pub fn json(diagnostics: &[Diagnostic], sources: &Sources) -> Value {
    diagnostics.iter().map(|diagnostic| one(diagnostic, sources)).collect()
}

fn one(diagnostic: &Diagnostic, sources: &Sources) -> Value {
    let labels = |labels: &[Label]| labels.iter().map(|label| place(label, sources)).collect::<Value>();
    json!({
        "code": diagnostic.code,
        "severity": diagnostic.severity,
        "message": diagnostic.message,
        "help": diagnostic.help,
        "labels": labels(&diagnostic.labels),
        "related": labels(&diagnostic.related),
    })
}

fn place(label: &Label, sources: &Sources) -> Value {
    let file = sources.file(label.span.file);
    let end = |byte: u32| {
        let place = file.line_column(byte as usize);
        json!({ "byte": byte, "line": place.line, "column": place.column })
    };
    json!({ "text": label.text, "file": file.name, "start": end(label.span.start), "end": end(label.span.end) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diag::Code;
    use crate::source::Span;

    #[test]
    fn places_have_bytes_lines_and_columns() {
        let mut sources = Sources::default();
        let file = sources.add("a.nb", "circuit\n  é }\n");
        let diagnostic = Diagnostic::new(Code::Syntax, "unexpected `}`", Span::new(file, 13, 14), "here");
        let label = &json(&[diagnostic], &sources)[0]["labels"][0];
        assert_eq!(label["start"], json!({ "byte": 13, "line": 2, "column": 5 }));
        assert_eq!(label["end"], json!({ "byte": 14, "line": 2, "column": 6 }));
    }
}
