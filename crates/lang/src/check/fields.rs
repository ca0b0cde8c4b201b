//! The fields of a record: no duplicates, no unknown fields, all required fields present.

use crate::check::record_fields::{Fact, RecordField, record_fields};
use crate::check::wording;
use crate::syntax::tree::{NameSyntax, RecordDeclaration, RecordSyntax, ValueKind, ValueSyntax};
use nbc_base::diag::{Diagnostic, Suggestion};
use nbc_base::source::Span;

pub(crate) struct Fields<'a> {
    what: String,
    rules: &'static [RecordField],
    place: Span,
    record: &'a RecordSyntax,
    /// Facts that decide which fields have an effect.
    facts: Vec<Fact>,
    /// Whether an error hides a fact.
    is_vague: bool,
    /// Each missing required field with an example.
    missing: Vec<[&'static str; 2]>,
    pub(crate) faults: Vec<Diagnostic>,
}

impl<'a> Fields<'a> {
    pub(crate) fn new(kind: &str, source: &'a RecordDeclaration) -> Self {
        let what = wording::record(kind, Some(&source.name.text));
        Self { what, place: source.name.span, ..Self::inner(kind, source.record.span, &source.record) }
    }

    pub(crate) fn inner(kind: &str, place: Span, record: &'a RecordSyntax) -> Self {
        let (what, rules) = (wording::record(kind, None), record_fields(kind));
        let (facts, missing, faults) = (Vec::new(), Vec::new(), Vec::new());
        Self { what, rules, place, record, facts, is_vague: false, missing, faults }
    }

    pub(crate) fn note(&mut self, field: &'static str, word: &'static str) {
        self.facts.push((field, word));
    }

    pub(crate) fn note_fault(&mut self) {
        self.is_vague = true;
    }

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

    pub(crate) fn value(&mut self, field: &'static str) -> Option<&'a ValueSyntax> {
        debug_assert!(self.rules.iter().any(|rule| rule.name == field), "{field} of {} has a rule", self.what);
        self.record.field(field).map(|given| &given.value)
    }

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

    pub(crate) fn read_list<T>(
        &mut self,
        field: &'static str,
        read: impl FnMut(&'a ValueSyntax) -> Result<T, Diagnostic>,
    ) -> Option<Vec<T>> {
        let value = self.value(field)?;
        let (entries, faults): (Vec<_>, Vec<_>) = list(value).iter().map(read).partition(Result::is_ok);
        self.faults.extend(faults.into_iter().filter_map(Result::err));
        if list(value).is_empty() {
            self.faults.push(wording::empty_list(field, value.span));
        }
        Some(entries.into_iter().filter_map(Result::ok).collect())
    }

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

    /// The errors if it is unknown which fields are allowed.
    pub(crate) fn abandon(self) -> Vec<Diagnostic> {
        self.errors(false)
    }

    /// Call it after all allowed fields were read.
    pub(crate) fn finish(self) -> Vec<Diagnostic> {
        self.errors(true)
    }

    /// If not `all` allowed fields were read, an unknown field may be one of them.
    fn errors(mut self, all: bool) -> Vec<Diagnostic> {
        let known = self.rules.iter().filter(|rule| rule.is_listed(&self.facts)).map(|rule| rule.name);
        let known: Vec<&str> = known.collect();
        for (at, field) in self.record.fields.iter().enumerate() {
            let NameSyntax { text: name, span } = &field.name;
            let rule = self.rules.iter().find(|rule| rule.name == *name);
            if let Some(first) = self.record.fields[..at].iter().find(|first| first.name.text == *name) {
                self.faults.push(wording::duplicate("field", &field.name, first.name.span));
            } else if let Some(needs) = rule.filter(|_| all && !self.is_vague).and_then(|rule| rule.lacks(&self.facts))
            {
                self.faults.push(wording::idle_field(&self.what, name, needs, *span));
            } else if !known.contains(&name.as_str()) {
                let left = known.iter().copied().filter(|known| self.record.field(known).is_none());
                let meant = Suggestion::near(name, left);
                if all || meant != Suggestion::None {
                    // A misspelled field is not missing, too.
                    self.missing.retain(|[field, _]| meant != Suggestion::Near((*field).to_owned()));
                    self.faults.push(wording::unknown_field(&self.what, name, &known, &meant, *span));
                }
            }
        }
        let missing = self.missing.iter();
        let missing = missing.map(|[field, example]| wording::missing_field(&self.what, field, example, self.place));
        self.faults.extend(missing);
        self.faults
    }
}

pub(crate) fn word<'v>(value: &'v ValueSyntax, expected: &str) -> Result<&'v NameSyntax, Diagnostic> {
    single(value).ok_or_else(|| wording::wrong_kind(expected, value.span))
}

pub(crate) fn name<'v>(value: &'v ValueSyntax, kind: &str) -> Result<&'v NameSyntax, Diagnostic> {
    single(value).ok_or_else(|| wording::wrong_kind(&wording::name_of(kind), value.span))
}

fn single(value: &ValueSyntax) -> Option<&NameSyntax> {
    match &value.kind {
        ValueKind::Instance(instance) if instance.arguments.is_empty() => Some(&instance.name),
        _ => None,
    }
}

pub(crate) fn choice<T: Copy>(value: &ValueSyntax, choices: &[(&'static str, T)]) -> Result<T, Diagnostic> {
    let found = single(value).and_then(|name| choices.iter().find(|(word, _)| *word == name.text));
    found.map(|(_, choice)| *choice).ok_or_else(|| {
        let words: Vec<&str> = choices.iter().map(|(word, _)| *word).collect();
        not_one_of(value, &wording::one_of(&words), &words)
    })
}

pub(crate) fn word_of<T: PartialEq>(choices: &[(&'static str, T)], choice: T) -> &'static str {
    choices.iter().find(|(_, known)| *known == choice).map_or("", |(word, _)| word)
}

pub(crate) fn unknown_word(name: &NameSyntax, expected: &str, words: &[&str]) -> Diagnostic {
    let meant = Suggestion::near(&name.text, words.iter().copied().filter(|word| *word != name.text));
    wording::unknown_choice(&name.text, expected, &meant, name.span)
}

/// As [`unknown_word`], for a value that may be something else than a word.
pub(crate) fn not_one_of(value: &ValueSyntax, expected: &str, words: &[&str]) -> Diagnostic {
    match single(value) {
        Some(name) => unknown_word(name, expected, words),
        None => wording::wrong_kind(expected, value.span),
    }
}

/// A single value is a list of one.
pub(crate) fn list(value: &ValueSyntax) -> &[ValueSyntax] {
    match &value.kind {
        ValueKind::List(values) => values,
        _ => std::slice::from_ref(value),
    }
}
