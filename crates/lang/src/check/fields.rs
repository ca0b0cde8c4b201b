//! The fields of a record: no duplicates, no unknown fields, all required fields present.

use crate::check::applies::{Fact, needs};
use crate::check::names::duplicate;
use crate::check::quantity::wrong_kind;
use crate::check::wording::{self, Expected, FieldError, ValueError};
use crate::syntax::tree::{NameSyntax, RecordDeclaration, RecordSyntax, ValueKind, ValueSyntax};
use nbc_base::diag::{Diagnostic, Suggestion};
use nbc_base::source::Span;

/// A record while it is read.
pub(crate) struct Fields<'a> {
    /// The owner of the fields, for messages.
    what: wording::Record,
    place: Span,
    record: &'a RecordSyntax,
    known: Vec<&'static str>,
    /// What decides which fields have an effect.
    facts: Vec<Fact>,
    /// Whether an error hides some of these.
    is_vague: bool,
    /// The required fields that are missing, each with an example.
    missing: Vec<[&'static str; 2]>,
    pub(crate) faults: Vec<Diagnostic>,
}

impl<'a> Fields<'a> {
    /// The fields of a declaration of that kind.
    pub(crate) fn new(kind: &'static str, source: &'a RecordDeclaration) -> Self {
        let what = wording::Record { kind, name: Some(source.name.text.clone()) };
        Self {
            what,
            place: source.name.span,
            record: &source.record,
            known: Vec::new(),
            facts: Vec::new(),
            is_vague: false,
            missing: Vec::new(),
            faults: Vec::new(),
        }
    }

    /// The fields of a record of that kind inside another.
    pub(crate) fn inner(kind: &'static str, place: Span, record: &'a RecordSyntax) -> Self {
        let what = wording::Record { kind, name: None };
        let (known, facts, missing, faults) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Self { what, place, record, known, facts, is_vague: false, missing, faults }
    }

    /// Notes what the record is or has, on which the effect of other fields depends.
    pub(crate) fn note(&mut self, field: &'static str, word: &'static str) {
        self.facts.push((field, word));
    }

    /// Notes that it is unknown which fields have an effect.
    pub(crate) fn note_fault(&mut self) {
        self.is_vague = true;
    }

    /// A field with one word of a set, on which the effect of other fields depends.
    pub(crate) fn choose<T: Copy + PartialEq>(
        &mut self,
        field: &'static str,
        default: T,
        choices: &[(&'static str, T)],
    ) -> T {
        let before = self.faults.len();
        let chosen = self.read(field, default, |value| choice(value, choices));
        self.is_vague |= self.faults.len() > before;
        self.note(field, word_of(choices, chosen));
        chosen
    }

    /// The value of a field.
    pub(crate) fn value(&mut self, field: &'static str) -> Option<&'a ValueSyntax> {
        // A field that has several forms is read once for each.
        if !self.known.contains(&field) {
            debug_assert!(needs(self.what.kind, field).is_some(), "{field} of a {} has a rule", self.what.kind);
            self.known.push(field);
        }
        self.record.field(field).map(|given| &given.value)
    }

    /// A field read by `read`, or `default` if it is missing or invalid.
    pub(crate) fn read<T>(
        &mut self,
        field: &'static str,
        default: T,
        read: impl FnOnce(&'a ValueSyntax) -> Result<T, Diagnostic>,
    ) -> T {
        match self.value(field).map(read) {
            Some(Ok(value)) => value,
            Some(Err(fault)) => {
                self.faults.push(fault);
                default
            }
            None => default,
        }
    }

    /// A field with a list of at least one entry, each read by `read`. Every invalid entry is reported.
    pub(crate) fn read_list<T>(
        &mut self,
        field: &'static str,
        read: impl FnMut(&'a ValueSyntax) -> Result<T, Diagnostic>,
    ) -> Option<Vec<T>> {
        let value = self.value(field)?;
        let (entries, faults): (Vec<_>, Vec<_>) = list(value).iter().map(read).partition(Result::is_ok);
        self.faults.extend(faults.into_iter().filter_map(Result::err));
        if list(value).is_empty() {
            self.faults.push(ValueError::EmptyList { field }.at(value.span));
        }
        Some(entries.into_iter().filter_map(Result::ok).collect())
    }

    /// A required field, read by `read`.
    pub(crate) fn need<T>(
        &mut self,
        field: &'static str,
        example: &'static str,
        read: impl FnOnce(&'a ValueSyntax) -> Result<T, Diagnostic>,
    ) -> Option<T> {
        if let Some(value) = self.value(field) {
            return read(value).map_err(|fault| self.faults.push(fault)).ok();
        }
        self.missing.push([field, example]);
        None
    }

    /// The errors of the fields where it is not known which others are allowed.
    pub(crate) fn abandon(self) -> Vec<Diagnostic> {
        self.errors(false)
    }

    /// All errors of the fields; call it after all allowed fields were read.
    pub(crate) fn finish(self) -> Vec<Diagnostic> {
        self.errors(true)
    }

    /// The facts of which a field needs one, if none of them holds.
    fn idle(&self, field: &str) -> Option<&'static [Fact]> {
        let facts = needs(self.what.kind, field)?;
        (!self.is_vague && !facts.is_empty() && !facts.iter().any(|fact| self.facts.contains(fact))).then_some(facts)
    }

    /// The errors; if not `all` allowed fields were read, an unknown field may be one of these.
    fn errors(mut self, all: bool) -> Vec<Diagnostic> {
        for (at, field) in self.record.fields.iter().enumerate() {
            let name = &field.name;
            if let Some(first) = self.record.fields[..at].iter().find(|first| first.name.text == name.text) {
                self.faults.push(duplicate("field", name, first.name.span));
            } else if let Some(with) = self.idle(&name.text).filter(|_| all) {
                let (record, field) = (self.what.clone(), name.text.clone());
                self.faults.push(FieldError::NoEffect { record, field, with }.at(name.span));
            } else if !self.known.contains(&name.text.as_str()) {
                let left = self.known.iter().copied().filter(|known| self.record.field(known).is_none());
                let meant = Suggestion::near(&name.text, left);
                if all || meant != Suggestion::None {
                    // A misspelled field is not missing, too.
                    self.missing.retain(|[field, _]| meant != Suggestion::Near((*field).to_owned()));
                    let (record, field, known) = (self.what.clone(), name.text.clone(), self.known.clone());
                    self.faults.push(FieldError::Unknown { record, field, known, meant }.at(name.span));
                }
            }
        }
        for [field, example] in self.missing {
            self.faults.push(FieldError::Missing { record: self.what.clone(), field, example }.at(self.place));
        }
        self.faults
    }
}

/// A single word.
pub(crate) fn word(value: &ValueSyntax, expected: Expected) -> Result<&NameSyntax, Diagnostic> {
    match &value.kind {
        ValueKind::Instance(instance) if instance.arguments.is_empty() => Ok(&instance.name),
        _ => Err(wrong_kind(expected, value.span)),
    }
}

/// One word of a set.
pub(crate) fn choice<T: Copy>(value: &ValueSyntax, choices: &[(&'static str, T)]) -> Result<T, Diagnostic> {
    let words: Vec<_> = choices.iter().map(|(word, _)| *word).collect();
    let expected = Expected::OneOf(words.clone());
    let name = word(value, expected.clone())?;
    choices
        .iter()
        .find(|(word, _)| *word == name.text)
        .map(|(_, choice)| *choice)
        .ok_or_else(|| unknown_word(name, expected, &words))
}

/// The word of a choice.
pub(crate) fn word_of<T: PartialEq>(choices: &[(&'static str, T)], choice: T) -> &'static str {
    choices.iter().find(|(_, known)| *known == choice).map_or("", |(word, _)| word)
}

/// The error for a word that is not one of `words`, perhaps with the one that is meant.
pub(crate) fn unknown_word(name: &NameSyntax, expected: Expected, words: &[&str]) -> Diagnostic {
    let meant = Suggestion::near(&name.text, words.iter().copied().filter(|word| *word != name.text));
    ValueError::UnknownChoice { found: name.text.clone(), expected, meant }.at(name.span)
}

/// As [`unknown_word`], for a value that may be something else than a word.
pub(crate) fn not_one_of(value: &ValueSyntax, expected: Expected, words: &[&str]) -> Diagnostic {
    match word(value, expected.clone()) {
        Ok(name) => unknown_word(name, expected, words),
        Err(error) => error,
    }
}

/// The values of a list; a single value is a list of one.
pub(crate) fn list(value: &ValueSyntax) -> &[ValueSyntax] {
    match &value.kind {
        ValueKind::List(values) => values,
        _ => std::slice::from_ref(value),
    }
}
