//! Names: one table for each kind of declaration. Names of a file take precedence over those of the prelude.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;

use crate::check::uses::{NameKind, NameUse};
use crate::check::wording::NameError;
use crate::syntax::tree::NameSyntax;
use nbc_base::diag::{Diagnostic, Suggestion, suggest};
use nbc_base::source::Span;

/// The origin of a declaration.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Home {
    /// The prelude, which files may redeclare.
    Prelude,
    /// A circuit file of another tool: it declares circuits, and calls those of the prelude only.
    Foreign,
    /// A file imported by another.
    Used,
    /// The checked file.
    Own,
}

/// The names of one kind of declaration, with their positions in the program.
pub(crate) struct NameTable {
    kind: NameKind,
    prelude: BTreeMap<String, Entry>,
    files: BTreeMap<String, Entry>,
    /// The number of unknown names looked up so far.
    unknown: Cell<usize>,
    /// The names declared and resolved so far.
    uses: RefCell<Vec<NameUse>>,
}

#[derive(Clone, Copy)]
struct Entry {
    index: usize,
    span: Span,
}

impl NameTable {
    pub(crate) fn new(kind: NameKind) -> Self {
        Self { kind, prelude: BTreeMap::new(), files: BTreeMap::new(), unknown: Cell::new(0), uses: RefCell::default() }
    }

    /// What the names stand for.
    pub(crate) fn kind(&self) -> NameKind {
        self.kind
    }

    /// Adds a name, unless it is taken.
    pub(crate) fn declare(&mut self, name: &NameSyntax, index: usize, home: Home) -> Result<(), Diagnostic> {
        let table = if home == Home::Prelude { &mut self.prelude } else { &mut self.files };
        match table.get(&name.text) {
            Some(first) => Err(duplicate(self.kind.word(), name, first.span)),
            None => {
                table.insert(name.text.clone(), Entry { index, span: name.span });
                self.refer(name.span, name.span);
                Ok(())
            }
        }
    }

    /// The meaning of a name in a file, or in the prelude.
    pub(crate) fn find(&self, name: &str, home: Home) -> Option<usize> {
        self.entry(name, home).map(|entry| entry.index)
    }

    fn entry(&self, name: &str, home: Home) -> Option<Entry> {
        let file = self.files.get(name).filter(|_| !matches!(home, Home::Prelude | Home::Foreign));
        file.or_else(|| self.prelude.get(name)).copied()
    }

    /// The meaning of a name, or an error if it is unknown.
    pub(crate) fn resolve(&self, name: &NameSyntax, home: Home) -> Result<usize, Diagnostic> {
        self.resolve_beside(name, home, &[])
    }

    /// As [`NameTable::resolve`], where words of the language may have been meant too.
    pub(crate) fn resolve_beside(&self, name: &NameSyntax, home: Home, words: &[&str]) -> Result<usize, Diagnostic> {
        let entry = self.entry(&name.text, home).ok_or_else(|| {
            let meant = self.suggestion(&name.text, words);
            NameError::Unknown { kind: self.kind.word(), name: name.text.clone(), meant }.at(name.span)
        })?;
        self.refer(name.span, entry.span);
        Ok(entry.index)
    }

    fn refer(&self, place: Span, declared: Span) {
        self.uses.borrow_mut().push(NameUse { place, declared, kind: self.kind });
    }

    /// Adds names that were resolved otherwise.
    pub(crate) fn note(&self, uses: impl Iterator<Item = NameUse>) {
        self.uses.borrow_mut().extend(uses);
    }

    /// The names declared and resolved so far.
    pub(crate) fn take_uses(&self) -> Vec<NameUse> {
        self.uses.take()
    }

    /// A suggestion for an unknown name, for the first unknown names only.
    fn suggestion(&self, name: &str, words: &[&str]) -> Suggestion {
        self.unknown.set(self.unknown.get() + 1);
        let known = words.iter().copied().chain(self.all());
        if self.unknown.get() <= suggest::MOST { Suggestion::of(name, known) } else { Suggestion::None }
    }

    /// Every name, in order.
    pub(crate) fn all(&self) -> impl Iterator<Item = &str> {
        self.files.keys().chain(self.prelude.keys().filter(|name| !self.files.contains_key(*name))).map(String::as_str)
    }

    /// Whether a file redeclares this name of the prelude.
    pub(crate) fn is_redeclared(&self, name: &str) -> bool {
        self.files.contains_key(name) && self.prelude.contains_key(name)
    }
}

/// A name that is declared twice.
pub(crate) fn duplicate(kind: &'static str, name: &NameSyntax, first: Span) -> Diagnostic {
    NameError::Duplicate { kind, name: name.text.clone(), first }.at(name.span)
}
