//! Bodies from any YAML or JSON mapping that has one.

use std::sync::Arc;

use serde::Deserialize;

use crate::{wording, yaml};
use nbc_base::diag::Diagnostic;
use nbc_base::model::{Body, BodyError, Palette};
use nbc_base::source::{SourceFile, Span};

#[derive(Deserialize)]
#[serde(expecting = "a mapping with a `body`")]
struct BodyFile {
    body: Rows,
    /// In order of their codes; empty for the paper's materials.
    #[serde(default)]
    materials: Option<Arc<Palette>>,
}

#[derive(Deserialize)]
#[serde(untagged, expecting = "invalid `body`; expected rows of codes such as [\"00345\", \"33333\"]")]
enum Rows {
    Block(String),
    List(Vec<Row>),
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Row {
    Text(String),
    // Rows without quotes and leading zeros are numbers to YAML.
    Number(u64),
    Codes(Vec<u8>),
}

impl Rows {
    fn into_text(self) -> Vec<String> {
        match self {
            Self::Block(text) => text.lines().map(|line| line.trim().to_owned()).collect(),
            Self::List(rows) => rows.into_iter().map(Row::into_text).collect(),
        }
    }
}

impl Row {
    fn into_text(self) -> String {
        match self {
            Self::Text(text) => text,
            Self::Number(number) => number.to_string(),
            Self::Codes(codes) => codes.iter().map(|&code| char::from_digit(code.into(), 36).unwrap_or('?')).collect(),
        }
    }
}

/// Reads a robot file, or any YAML or JSON mapping whose `body` is rows of codes; `materials` may define the codes.
pub fn read_body(file: &SourceFile) -> Result<Body, Diagnostic> {
    let BodyFile { body, materials } = yaml::read(file).map_err(wording::with_body_example)?;
    self::body(file, &body.into_text(), &materials.unwrap_or_else(Palette::paper))
}

pub(super) fn body(file: &SourceFile, rows: &[String], palette: &Arc<Palette>) -> Result<Body, Diagnostic> {
    let body = Body::parse(rows, palette).map_err(|error| fault(file, rows, &error))?;
    if body.is_connected() {
        return Ok(body);
    }
    Err(wording::two_pieces(file, yaml::key_span(file, "body")))
}

fn fault(file: &SourceFile, rows: &[String], error: &BodyError) -> Diagnostic {
    let body = yaml::key_span(file, "body");
    let span = match *error {
        BodyError::Empty | BodyError::CodeRange { .. } | BodyError::TooLarge { .. } => body,
        BodyError::Ragged { row, .. } => row_span(file, body, rows, row - 1).unwrap_or(body),
        BodyError::UnknownCode { row, column, .. } => row_span(file, body, rows, row - 1).map_or(body, |span| {
            let at =
                |column| span.range().start + rows[row - 1].chars().take(column).map(char::len_utf8).sum::<usize>();
            Span::new(file.id, at(column - 1), at(column))
        }),
    };
    wording::no_body(file, error, span)
}

/// Finds a row by searching for one row after another; `None` if rows are written in another notation.
fn row_span(file: &SourceFile, body: Span, rows: &[String], wanted: usize) -> Option<Span> {
    let mut at = body.range().end;
    for row in &rows[..wanted] {
        at += file.text[at..].find(row.as_str())? + row.len();
    }
    let start = at + file.text[at..].find(rows[wanted].as_str())?;
    Some(Span::new(file.id, start, start + rows[wanted].len()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_base::source::Sources;

    fn read(text: &str) -> Result<Vec<String>, (String, String)> {
        let mut sources = Sources::default();
        let id = sources.add("a.yaml", text);
        read_body(sources.file(id))
            .map(|body| body.rows())
            .map_err(|fault| (fault.message, sources.text(fault.labels[0].span).to_owned()))
    }

    fn check(text: &str, expected: &[&str]) {
        assert_eq!(read(text), Ok(expected.iter().map(|row| row.to_string()).collect()));
    }

    fn check_fault(text: &str, message: &str, place: &str) {
        let (found, at) = read(text).unwrap_err();
        assert!(found.contains(message), "{found:?} does not say {message:?}");
        assert_eq!(at, place, "{found}");
    }

    #[test]
    fn bodies_are_read_in_any_notation_of_rows() {
        check("body: [\"00345\", \"33333\"]", &["00345", "33333"]);
        check("{\"name\": \"x\", \"body\": [\"00345\", \"33333\"]}", &["00345", "33333"]);
        check("body:\n  - 00345\n  - 33333\n", &["00345", "33333"]);
        check("body: |\n  00345\n  33333\n", &["00345", "33333"]);
        check("body: [[0, 3], [3, 3]]", &["03", "33"]);
    }

    #[test]
    fn errors_are_shown_at_their_place() {
        check_fault("body: [\"33\", \"333\"]", "row 2 has 3 voxels, expected 2", "333");
        check_fault("body: [\"33\", \"39\"]", "`9` is not a material code", "9");
        check_fault("name: x\nbody: []", "the body has no voxels", "body");
        check_fault("body: [\"00\"]", "the body has no voxels", "body");
    }

    #[test]
    fn anything_but_a_mapping_with_a_body_is_rejected() {
        for text in
            ["", "name: x", "33", "body: 33.5", "body: {a: 1}", "body: [-3]", "\u{0}", "body: [", "- body", "&a [*a]"]
        {
            assert!(read(text).is_err(), "{text:?} was read as {:?}", read(text));
        }
    }
}
