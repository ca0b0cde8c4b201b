//! YAML that any reader loads, and YAML's errors as diagnostics with places.

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::store::wording::RobotFileError;
use nbc_base::diag::Diagnostic;
use nbc_base::source::{FileId, SourceFile, Span};

/// The largest robot file, in bytes; the largest body takes a tenth of it.
pub const MAX_ROBOT_BYTES: u64 = 1 << 20;

/// The deepest nesting of brackets, because the reader's time grows with its square.
const MAX_DEPTH: usize = 64;

/// Words that some readers take for numbers, booleans or null.
const RESERVED: [&str; 13] =
    ["y", "n", "yes", "no", "on", "off", "true", "false", "null", "inf", "nan", "infinity", "~"];

/// Reads a text of one document.
///
/// # Errors
/// A diagnostic with its place.
pub(super) fn read<T: DeserializeOwned>(file: &SourceFile) -> Result<T, Diagnostic> {
    if file.text.len() as u64 > MAX_ROBOT_BYTES {
        return Err(RobotFileError::TooLarge { most: MAX_ROBOT_BYTES }.of(&file.name, None));
    }
    if let Some(at) = too_deep(&file.text) {
        return Err(RobotFileError::TooDeep { most: MAX_DEPTH }.of(&file.name, span(file.id, at, 1)));
    }
    serde_yaml::from_str(&file.text).map_err(|error| fault(file, &error))
}

/// The place of the first bracket that is nested too deep.
fn too_deep(text: &str) -> Option<usize> {
    let mut depth = 0usize;
    text.bytes().position(|byte| {
        match byte {
            b'[' | b'{' => depth += 1,
            b']' | b'}' => depth = depth.saturating_sub(1),
            _ => {}
        }
        depth > MAX_DEPTH
    })
}

/// The text of a value, without tags, whose scalars every version of YAML reads alike.
pub(super) fn print<T: Serialize>(value: &T) -> String {
    let text = serde_yaml::to_string(value).expect("a robot can be written as YAML");
    text.lines().flat_map(|line| [portable(line), "\n".to_owned()]).collect()
}

/// A line whose plain scalar, if it ends in one, is read alike by versions 1.1 and 1.2 of YAML.
fn portable(line: &str) -> String {
    let start = line.rfind(": ").max(line.rfind("- ")).map_or(line.len(), |at| at + 2);
    let (head, scalar) = line.split_at(start);
    let quoted = || format!("{head}'{}'", scalar.replace('\'', "''"));
    let is_number = scalar.starts_with(|c: char| c.is_ascii_digit() || c == '-') && scalar.parse::<f64>().is_ok();
    if scalar.is_empty() || scalar.ends_with(':') || scalar.starts_with(['\'', '"', '[', '{', '|', '>']) {
        return line.to_owned();
    }
    if is_number {
        return format!("{head}{}", portable_number(scalar));
    }
    let is_truth = scalar == "true" || scalar == "false";
    let is_word = scalar.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && scalar.chars().all(|c| c.is_ascii_alphanumeric() || "_-.".contains(c));
    let is_reserved = RESERVED.iter().any(|word| scalar.eq_ignore_ascii_case(word));
    if is_truth || (is_word && !is_reserved) { line.to_owned() } else { quoted() }
}

/// A number with a point and a signed exponent, as required by YAML 1.1, which reads `1e-7` as text.
fn portable_number(number: &str) -> String {
    let Some((digits, exponent)) = number.split_once('e') else { return number.to_owned() };
    let point = if digits.contains('.') { "" } else { ".0" };
    let sign = if exponent.starts_with('-') { "" } else { "+" };
    format!("{digits}{point}e{sign}{exponent}")
}

/// The error of the YAML reader, at its place.
fn fault(file: &SourceFile, error: &serde_yaml::Error) -> Diagnostic {
    let words = error.to_string();
    // The place is shown by the diagnostic.
    let message = words.split(" at line ").next().unwrap_or(&words).replace('\n', " ");
    let span = match error.location() {
        Some(place) => span_at(file, place.line(), place.column()),
        None => quoted_span(file, &message),
    };
    RobotFileError::Shape(message).of(&file.name, span)
}

/// The place of the first word in backticks that occurs in the text, for errors without a place.
fn quoted_span(file: &SourceFile, message: &str) -> Span {
    let quoted = message.split('`').skip(1).step_by(2).filter(|word| !word.is_empty());
    let found = quoted.filter_map(|word| Some(span(file.id, file.text.find(word)?, word.len()))).next();
    found.unwrap_or(span(file.id, 0, 0))
}

/// The span of one character at a line and a column in characters, both from 1.
fn span_at(file: &SourceFile, line: usize, column: usize) -> Span {
    let start: usize = file.text.split_inclusive('\n').take(line - 1).map(str::len).sum();
    let rest = &file.text[start..];
    let at = start + rest.char_indices().nth(column - 1).map_or(rest.len(), |(at, _)| at);
    let length = file.text[at..].chars().next().filter(|c| *c != '\n').map_or(0, char::len_utf8);
    Span::new(file.id, at, at + length)
}

/// The span of a key, or the start of the text if the key is missing.
pub(super) fn key_span(file: &SourceFile, key: &str) -> Span {
    let start = file.text.find(&format!("{key}:")).or_else(|| file.text.find(&format!("\"{key}\"")));
    let length = if start.is_some() { key.len() } else { 0 };
    span(file.id, start.unwrap_or(0), length)
}

fn span(file: FileId, start: usize, length: usize) -> Span {
    Span::new(file, start, start + length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scalars_read_the_same_in_every_version_of_yaml() {
        let check = |line: &str, expected: &str| assert_eq!(portable(line), expected);
        check("margin: 1e-7", "margin: 1.0e-7");
        check("- -2.5e17", "- -2.5e+17");
        check("clock: 4", "clock: 4");
        check("name: no", "name: 'no'");
        check("- 0b11", "- '0b11'");
        check("- - 1_0", "- - '1_0'");
        check("topples: false", "topples: false");
        check("name: and_5x5", "name: and_5x5");
        check("- '00345'", "- '00345'");
        check("settle:", "settle:");
        check("    - output:", "    - output:");
    }

    #[test]
    fn nesting_of_brackets_is_limited() {
        assert_eq!(too_deep(&"[".repeat(64)), None);
        assert_eq!(too_deep(&"[]".repeat(1000)), None);
        assert_eq!(too_deep(&format!("a: {}", "[{".repeat(100_000))), Some(3 + 64));
    }
}
