//! Names: one table for each kind of declaration. Names of a file take precedence over those of the prelude.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;

use crate::check::uses::{NameKind, NameUse};
use crate::check::wording;
use crate::syntax::tree::NameSyntax;
use nbc_base::diag::{Diagnostic, Suggestion, suggest};
use nbc_base::source::Span;

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Home {
    /// Files may redeclare its names.
    Prelude,
    Used,
    Own,
}

pub(crate) struct NameTable<T = usize> {
    pub(crate) kind: NameKind,
    prelude: BTreeMap<String, Entry<T>>,
    files: BTreeMap<String, Entry<T>>,
    unknown: Cell<usize>,
    uses: RefCell<Vec<NameUse>>,
}

#[derive(Clone, Copy)]
struct Entry<T> {
    meaning: T,
    span: Span,
}

impl<T: Copy> NameTable<T> {
    pub(crate) fn new(kind: NameKind) -> Self {
        Self { kind, prelude: BTreeMap::new(), files: BTreeMap::new(), unknown: Cell::new(0), uses: RefCell::default() }
    }

    pub(crate) fn declare(&mut self, name: &NameSyntax, meaning: T, home: Home) -> Result<(), Diagnostic> {
        let table = if home == Home::Prelude { &mut self.prelude } else { &mut self.files };
        match table.get(&name.text) {
            Some(first) => Err(wording::duplicate(self.kind.word(), name, first.span)),
            None => {
                table.insert(name.text.clone(), Entry { meaning, span: name.span });
                self.refer(name.span, name.span);
                Ok(())
            }
        }
    }

    pub(crate) fn find(&self, name: &str, home: Home) -> Option<T> {
        self.entry(name, home).map(|entry| entry.meaning)
    }

    fn entry(&self, name: &str, home: Home) -> Option<Entry<T>> {
        let file = self.files.get(name).filter(|_| home != Home::Prelude);
        file.or_else(|| self.prelude.get(name)).copied()
    }

    pub(crate) fn resolve(&self, name: &NameSyntax, home: Home) -> Result<T, Diagnostic> {
        self.resolve_beside(name, home, &[])
    }

    pub(crate) fn resolve_beside(&self, name: &NameSyntax, home: Home, words: &[&str]) -> Result<T, Diagnostic> {
        let entry = self
            .entry(&name.text, home)
            .ok_or_else(|| wording::unknown(self.kind.word(), name, &self.suggestion(&name.text, words)))?;
        self.refer(name.span, entry.span);
        Ok(entry.meaning)
    }

    pub(crate) fn refer_to(&self, name: &str, place: Span, home: Home) {
        if let Some(entry) = self.entry(name, home) {
            self.refer(place, entry.span);
        }
    }

    fn count(&self) -> usize {
        self.uses.borrow().len()
    }

    /// The places of the uses after the first `count`.
    pub(crate) fn places_from(&self, count: usize) -> Vec<Span> {
        self.uses.borrow()[count..].iter().map(|found| found.place).collect()
    }

    fn refer(&self, place: Span, declared: Span) {
        self.uses.borrow_mut().push(NameUse { place, declared, kind: self.kind });
    }

    pub(crate) fn is_used(&self, declared: Span) -> bool {
        self.uses.borrow().iter().any(|found| found.declared == declared && found.place != declared)
    }

    pub(crate) fn note(&self, uses: impl Iterator<Item = NameUse>) {
        self.uses.borrow_mut().extend(uses);
    }

    pub(crate) fn take_uses(&self) -> Vec<NameUse> {
        self.uses.take()
    }

    fn suggestion(&self, name: &str, words: &[&str]) -> Suggestion {
        self.unknown.set(self.unknown.get() + 1);
        let known = words.iter().copied().chain(self.all());
        if self.unknown.get() <= suggest::MOST { Suggestion::of(name, known) } else { Suggestion::None }
    }

    pub(crate) fn all(&self) -> impl Iterator<Item = &str> {
        self.files.keys().chain(self.prelude.keys().filter(|name| !self.files.contains_key(*name))).map(String::as_str)
    }

    pub(crate) fn is_redeclared(&self, name: &str) -> bool {
        self.files.contains_key(name) && self.prelude.contains_key(name)
    }
}

impl NameTable<Option<usize>> {
    pub(crate) fn add<T>(
        &mut self,
        name: &NameSyntax,
        checked: Option<T>,
        home: Home,
        list: &mut Vec<T>,
    ) -> Option<Diagnostic> {
        let error = self.declare(name, checked.as_ref().map(|_| list.len()), home).err();
        list.extend(checked);
        error
    }
}

#[derive(Clone, Copy)]
pub(crate) struct MemberPlace {
    pub(crate) enumeration: usize,
    pub(crate) member: usize,
}

/// A material, set of images, schedule or swarm with errors has a name, but no position in the program.
pub(crate) struct Names {
    pub(crate) stimuli: NameTable,
    pub(crate) materials: NameTable<Option<usize>>,
    pub(crate) images: NameTable<Option<usize>>,
    pub(crate) schedules: NameTable<Option<usize>>,
    /// Positions among the declarations.
    pub(crate) evolutions: NameTable,
    pub(crate) libraries: NameTable<()>,
    pub(crate) circuits: NameTable,
    /// Positions in the program.
    pub(crate) enumerations: NameTable,
    pub(crate) members: NameTable<MemberPlace>,
    pub(crate) integers: NameTable<i128>,
    pub(crate) files: NameTable,
    pub(crate) swarms: NameTable<Option<usize>>,
    /// Positions among the declarations.
    pub(crate) worlds: NameTable,
}

impl Names {
    pub(crate) fn new() -> Self {
        Self {
            stimuli: NameTable::new(NameKind::Stimulus),
            materials: NameTable::new(NameKind::Material),
            images: NameTable::new(NameKind::Images),
            schedules: NameTable::new(NameKind::Schedule),
            evolutions: NameTable::new(NameKind::Evolution),
            libraries: NameTable::new(NameKind::Library),
            circuits: NameTable::new(NameKind::Circuit),
            enumerations: NameTable::new(NameKind::Enumeration),
            members: NameTable::new(NameKind::Member),
            integers: NameTable::new(NameKind::Number),
            files: NameTable::new(NameKind::File),
            swarms: NameTable::new(NameKind::Swarm),
            worlds: NameTable::new(NameKind::World),
        }
    }

    /// How often circuits were named, and how often what else their bodies can name.
    pub(crate) fn counts(&self) -> (usize, usize) {
        let others = [self.enumerations.count(), self.files.count(), self.members.count(), self.integers.count()];
        (self.circuits.count(), others.iter().sum())
    }

    /// What bodies of circuits can name beside circuits.
    pub(crate) fn of_bodies(&self) -> Vec<String> {
        let places = self.enumerations.all().chain(self.files.all());
        places.chain(self.members.all()).chain(self.integers.all()).map(str::to_owned).collect()
    }

    pub(crate) fn take_uses(&self) -> Vec<NameUse> {
        let positions =
            [&self.stimuli, &self.evolutions, &self.circuits, &self.worlds, &self.enumerations, &self.files];
        let positions = positions.map(NameTable::take_uses);
        let optional = [&self.materials, &self.images, &self.schedules, &self.swarms].map(NameTable::take_uses);
        let others = [self.libraries.take_uses(), self.members.take_uses(), self.integers.take_uses()];
        [positions.concat(), optional.concat(), others.concat()].concat()
    }
}
