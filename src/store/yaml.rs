//! YAML's errors as diagnostics with places.

use crate::diag::{Code, Diagnostic};
use crate::source::{FileId, SourceFile, Span};

/// What YAML says of a text, at its place.
pub(super) fn fault(file: &SourceFile, error: &serde_yaml::Error) -> Diagnostic {
    let words = error.to_string();
    // The place is shown by the diagnostic.
    let message = words.split(" at line ").next().unwrap_or(&words).replace('\n', " ");
    let span = error.location().map_or(Span::new(file.id, 0, 0), |place| span_at(file, place.line(), place.column()));
    Diagnostic::new(Code::RobotFile, format!("`{}` is no robot file: {message}", file.name), span, "here")
}

/// The span of one character at a line and a column in characters, both from 1.
fn span_at(file: &SourceFile, line: usize, column: usize) -> Span {
    let start: usize = file.text.split_inclusive('\n').take(line - 1).map(str::len).sum();
    let rest = &file.text[start..];
    let at = start + rest.char_indices().nth(column - 1).map_or(rest.len(), |(at, _)| at);
    let length = file.text[at..].chars().next().filter(|c| *c != '\n').map_or(0, char::len_utf8);
    Span::new(file.id, at, at + length)
}

/// The span of a top-level key, or the text's start where the key is missing.
pub(super) fn key_span(file: &SourceFile, key: &str) -> Span {
    let start = file.text.find(&format!("{key}:")).or_else(|| file.text.find(&format!("\"{key}\"")));
    let length = if start.is_some() { key.len() } else { 0 };
    span(file.id, start.unwrap_or(0), length)
}

fn span(file: FileId, start: usize, length: usize) -> Span {
    Span::new(file, start, start + length)
}
