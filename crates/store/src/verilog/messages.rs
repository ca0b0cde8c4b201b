//! The messages of slang, as it writes them to a file of JSON.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::Deserialize;

use crate::verilog::wording;
use nbc_base::source::{VerilogNote, VerilogPlace};

const MOST: usize = 20;

#[derive(Deserialize)]
struct Message {
    severity: String,
    message: String,
    code: String,
    location: Option<String>,
    #[serde(default)]
    ranges: Vec<Range>,
}

#[derive(Deserialize)]
struct Range {
    start: Point,
    end: Point,
}

#[derive(Deserialize)]
struct Point {
    file: String,
    line: usize,
    column: usize,
}

/// The files in the sandbox, with the paths that messages name.
pub(super) type SandboxFiles = BTreeMap<String, Arc<str>>;

/// The errors, or the warnings if there are none.
pub(super) fn notes(json: &str, names: &SandboxFiles) -> Vec<VerilogNote> {
    let messages: Vec<Message> = serde_json::from_str(json).unwrap_or_default();
    let is_error = |message: &Message| matches!(message.severity.as_str(), "error" | "fatal");
    let has_errors = messages.iter().any(is_error);
    let is_told = |message: &&Message| {
        // Lists of events are looked at in the tree.
        let is_of_events = message.message.contains("non-edge sensitivity");
        is_error(message) == has_errors && message.severity != "note" && !is_of_events
    };
    let note =
        |message: &Message| wording::of_slang(has_errors, &message.message, &message.code, place(message, names));
    let mut notes: Vec<VerilogNote> = Vec::new();
    for message in messages.iter().filter(is_told) {
        let note = note(message);
        if !notes.contains(&note) {
            notes.push(note);
        }
    }
    let hidden = notes.len().saturating_sub(MOST);
    notes.truncate(MOST);
    if hidden > 0 {
        notes.push(wording::more(hidden));
    }
    notes
}

fn place(message: &Message, names: &SandboxFiles) -> Option<VerilogPlace> {
    let range = message.ranges.first().filter(|range| range.start.line == range.end.line);
    if let Some(Range { start, end }) = range {
        let columns = Some([start.column, end.column]);
        return Some(VerilogPlace { file: names.get(&start.file)?.clone(), line: start.line, columns });
    }
    let location = message.location.as_ref()?;
    let column = location.rsplit(':').next().and_then(|column| column.parse().ok());
    Some(VerilogPlace { columns: column.map(|first: usize| [first, first + 1]), ..at(location, names)? })
}

/// A place such as `a.v:3.8-3.9` or `a.v:3:8`, of the first if there are several.
pub(super) fn at(text: &str, names: &SandboxFiles) -> Option<VerilogPlace> {
    let first = text.split('|').next()?;
    let (file, place) = first.split_once(':')?;
    let mut numbers = place.split(|c: char| !c.is_ascii_digit()).map(str::parse);
    let line = numbers.next()?.ok()?;
    let column = numbers.next().and_then(Result::ok);
    let end = match numbers.collect::<Vec<_>>()[..] {
        [Ok(last), Ok(end), ..] if last == line => Some(end),
        _ => None,
    };
    let columns = column.zip(end).map(|(first, end)| [first, end]);
    Some(VerilogPlace { file: names.get(file)?.clone(), line, columns })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_come_without_warnings_and_at_their_place() {
        let names = SandboxFiles::from([("source0.v".to_owned(), Arc::from("my file.v"))]);
        let json = r#"[{"severity": "warning", "message": "odd", "code": "A"},
            {"severity": "error", "message": "bad", "code": "B", "location": "source0.v:2:3"}]"#;
        let place = VerilogPlace { file: "my file.v".into(), line: 2, columns: Some([3, 4]) };
        let expected = VerilogNote { is_error: true, message: "bad".into(), place: Some(place), ..Default::default() };
        assert_eq!(notes(json, &names), [expected]);
        let place = at("source0.v:3.8-3.12|source0.v:9.1-9.2", &names).unwrap();
        assert_eq!((place.line, place.columns), (3, Some([8, 12])));
        assert_eq!(at("source0.v:4.1", &names).map(|place| (place.line, place.columns)), Some((4, None)));
    }
}
