//! YAML that any reader loads, and YAML's errors as diagnostics with places.

use std::fmt;

use serde::de::{DeserializeOwned, DeserializeSeed, EnumAccess, Error, MapAccess, SeqAccess, VariantAccess, Visitor};
use serde::{Deserializer, Serialize};

use crate::wording;
use nbc_base::budget::{Limit, WorkBudget};
use nbc_base::diag::Diagnostic;
use nbc_base::source::{FileId, SourceFile, Span};

/// Words that some readers take for numbers, booleans or null.
const RESERVED: [&str; 13] =
    ["y", "n", "yes", "no", "on", "off", "true", "false", "null", "inf", "nan", "infinity", "~"];

pub(super) fn read<T: DeserializeOwned>(file: &SourceFile) -> Result<T, Diagnostic> {
    if Limit::RobotBytes.permit(file.text.len() as u64).is_err() {
        return Err(wording::too_large(file));
    }
    if let Some(at) = too_deep(&file.text) {
        return Err(wording::too_deep(file, span(file.id, at, 1)));
    }
    // Only an alias is longer than it is written.
    if file.text.contains('*') {
        let mut budget = WorkBudget::default();
        let counted = Tally(&mut budget).deserialize(serde_yaml::Deserializer::from_str(&file.text));
        if budget.left(Limit::RobotTextBytes) == 0 {
            return Err(wording::too_much(file));
        }
        counted.map_err(|error| fault(file, &error))?;
    }
    serde_yaml::from_str(&file.text).map_err(|error| fault(file, &error))
}

/// Reads any value and keeps nothing of it, but counts its texts; ends where there are too many.
struct Tally<'b>(&'b mut WorkBudget);

impl Tally<'_> {
    fn take<E: Error>(&mut self, bytes: usize) -> Result<(), E> {
        let bytes = (bytes as u64).saturating_add(VALUE_BYTES);
        let taken = self.0.take(Limit::RobotTextBytes, bytes);
        taken.map_err(|_| {
            // What is left says whether it was too much.
            let left = self.0.left(Limit::RobotTextBytes);
            _ = self.0.take(Limit::RobotTextBytes, left);
            E::custom("too much text")
        })
    }
}

const VALUE_BYTES: u64 = 8;

impl<'de> DeserializeSeed<'de> for Tally<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Tally<'_> {
    type Value = ();

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a value")
    }

    fn visit_bool<E: Error>(mut self, _: bool) -> Result<(), E> {
        self.take(0)
    }

    fn visit_i64<E: Error>(mut self, _: i64) -> Result<(), E> {
        self.take(0)
    }

    fn visit_u64<E: Error>(mut self, _: u64) -> Result<(), E> {
        self.take(0)
    }

    fn visit_f64<E: Error>(mut self, _: f64) -> Result<(), E> {
        self.take(0)
    }

    fn visit_str<E: Error>(mut self, text: &str) -> Result<(), E> {
        self.take(text.len())
    }

    fn visit_unit<E: Error>(mut self) -> Result<(), E> {
        self.take(0)
    }

    fn visit_seq<A: SeqAccess<'de>>(mut self, mut list: A) -> Result<(), A::Error> {
        self.take(0)?;
        while list.next_element_seed(Tally(self.0))?.is_some() {}
        Ok(())
    }

    fn visit_map<A: MapAccess<'de>>(mut self, mut entries: A) -> Result<(), A::Error> {
        self.take(0)?;
        while entries.next_key_seed(Tally(self.0))?.is_some() {
            entries.next_value_seed(Tally(self.0))?;
        }
        Ok(())
    }

    fn visit_enum<A: EnumAccess<'de>>(self, tagged: A) -> Result<(), A::Error> {
        let (tag, value) = tagged.variant::<String>()?;
        let Self(budget) = self;
        Tally(&mut *budget).take(tag.len())?;
        value.newtype_variant_seed(Tally(budget))
    }
}

fn too_deep(text: &str) -> Option<usize> {
    let mut depth = 0;
    text.bytes().position(|byte| {
        match byte {
            b'[' | b'{' => depth += 1,
            b']' | b'}' => depth = u64::saturating_sub(depth, 1),
            _ => {}
        }
        Limit::RobotNesting.permit(depth).is_err()
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

fn fault(file: &SourceFile, error: &serde_yaml::Error) -> Diagnostic {
    let words = error.to_string();
    // The place is shown by the diagnostic.
    let message = words.split(" at line ").next().unwrap_or(&words).replace('\n', " ");
    let span = match error.location() {
        Some(place) => span_at(file, place.line(), place.column()),
        None => quoted_span(file, &message),
    };
    wording::not_robot(file, &message, span)
}

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
