//! The fields of a record: no duplicates, no unknown fields, all required fields present.

use crate::diag::{Code, Diagnostic, suggest};
use crate::source::Span;
use crate::syntax::tree::{Record, Value, ValueKind};

/// A record while it is read.
pub(crate) struct Fields<'a> {
    /// The owner of the fields, for messages.
    what: String,
    name: Span,
    record: &'a Record,
    known: Vec<&'static str>,
    pub(crate) faults: Vec<Diagnostic>,
}

impl<'a> Fields<'a> {
    /// The fields of `what`, whose name is at `name`.
    pub(crate) fn new(what: impl Into<String>, name: Span, record: &'a Record) -> Self {
        Self { what: what.into(), name, record, known: Vec::new(), faults: Vec::new() }
    }

    /// The value of a field.
    pub(crate) fn value(&mut self, field: &'static str) -> Option<&'a Value> {
        self.known.push(field);
        self.record.fields.iter().find(|given| given.name.text == field).map(|given| &given.value)
    }

    /// A field read by `read`, or `default` if it is missing or invalid.
    pub(crate) fn read<T>(
        &mut self,
        field: &'static str,
        default: T,
        read: impl FnOnce(&'a Value) -> Result<T, Diagnostic>,
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
        read: impl FnMut(&'a Value) -> Result<T, Diagnostic>,
    ) -> Option<Vec<T>> {
        let value = self.value(field)?;
        let (entries, faults): (Vec<_>, Vec<_>) = list(value).iter().map(read).partition(Result::is_ok);
        self.faults.extend(faults.into_iter().filter_map(Result::err));
        if list(value).is_empty() {
            let message = format!("`{field}` is an empty list");
            self.faults.push(Diagnostic::new(Code::OutOfRange, message, value.span, "expected one entry at least"));
        }
        Some(entries.into_iter().filter_map(Result::ok).collect())
    }

    /// A required field, read by `read`.
    pub(crate) fn need<T>(
        &mut self,
        field: &'static str,
        example: &str,
        read: impl FnOnce(&'a Value) -> Result<T, Diagnostic>,
    ) -> Option<T> {
        if let Some(value) = self.value(field) {
            return read(value).map_err(|fault| self.faults.push(fault)).ok();
        }
        let message = format!("{} has no `{field}`", self.what);
        let fault = Diagnostic::new(Code::MissingField, message, self.name, format!("needs `{field}`"));
        self.faults.push(fault.with_help(format!("add `{example}`")));
        None
    }

    /// All errors of the fields; call it after all allowed fields were read.
    pub(crate) fn finish(mut self) -> Vec<Diagnostic> {
        for (at, field) in self.record.fields.iter().enumerate() {
            let name = &field.name;
            if let Some(first) = self.record.fields[..at].iter().find(|first| first.name.text == name.text) {
                self.faults.push(crate::check::names::duplicate("field", name, first.name.span));
            } else if !self.known.contains(&name.text.as_str()) {
                let message = format!("{} has no field `{}`", self.what, name.text);
                let fault = Diagnostic::new(Code::UnknownField, message, name.span, "unknown field");
                self.faults.push(match suggest::help(&name.text, self.known.iter().copied()) {
                    Some(help) => fault.with_help(help),
                    None => fault.with_help(format!("its fields are {}", suggest::alternatives(&self.known, "and"))),
                });
            }
        }
        self.faults
    }
}

/// A single word.
pub(crate) fn word<'a>(value: &'a Value, expected: &str) -> Result<&'a crate::syntax::tree::Name, Diagnostic> {
    match &value.kind {
        ValueKind::Instance(instance) if instance.arguments.is_empty() => Ok(&instance.name),
        _ => Err(super::quantity::wrong_kind(expected, value.span)),
    }
}

/// One word of a set.
pub(crate) fn choice<T: Copy>(value: &Value, choices: &[(&'static str, T)]) -> Result<T, Diagnostic> {
    let words: Vec<_> = choices.iter().map(|(word, _)| *word).collect();
    let expected = suggest::alternatives(&words, "or");
    let name = word(value, &expected)?;
    choices.iter().find(|(word, _)| *word == name.text).map(|(_, choice)| *choice).ok_or_else(|| {
        let message = format!("`{}` where {expected} belongs", name.text);
        let fault = Diagnostic::new(Code::Value, message, name.span, "not one of them");
        match suggest::nearest(&name.text, words) {
            Some(near) => fault.with_help(format!("did you mean `{near}`?")),
            None => fault,
        }
    })
}

/// The values of a list; a single value is a list of one.
pub(crate) fn list(value: &Value) -> &[Value] {
    match &value.kind {
        ValueKind::List(values) => values,
        _ => std::slice::from_ref(value),
    }
}
