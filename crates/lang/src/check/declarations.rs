//! The declarations of all files, the prelude's first.

use std::collections::BTreeMap;

use crate::check::names::Home;
use crate::syntax::tree::{self, DeclarationKind, RecordDeclaration, RecordKeyword, Tree};
use nbc_base::source::{FileId, Sources, Span};

pub(crate) struct Declarations<'a> {
    trees: &'a [(Home, Tree)],
    /// Starts and ends of declarations that have lost a part.
    broken: BTreeMap<(FileId, u32), u32>,
    pub(crate) sources: &'a Sources,
}

impl<'a> Declarations<'a> {
    pub(crate) fn new(trees: &'a [(Home, Tree)], sources: &'a Sources) -> Self {
        let broken = trees.iter().flat_map(|(_, tree)| &tree.broken).map(|part| part.declaration);
        let broken = broken.map(|declaration| ((declaration.file, declaration.start), declaration.end)).collect();
        Self { trees, broken, sources }
    }

    pub(crate) fn all(&self) -> impl Iterator<Item = (Home, &'a tree::Declaration)> + use<'a> {
        self.trees.iter().flat_map(|(home, tree)| tree.declarations.iter().map(|declaration| (*home, &**declaration)))
    }

    pub(crate) fn own(&self) -> impl Iterator<Item = &'a tree::Declaration> + use<'a> {
        self.all().filter(|(home, _)| *home == Home::Own).map(|(_, declaration)| declaration)
    }

    pub(crate) fn records(&self, keyword: RecordKeyword) -> Vec<(Home, &'a RecordDeclaration)> {
        let record = |(home, declaration): (Home, &'a tree::Declaration)| match &declaration.kind {
            DeclarationKind::Record(record) if record.keyword == keyword => Some((home, record)),
            _ => None,
        };
        self.all().filter_map(record).collect()
    }

    pub(crate) fn own_tests(&self) -> impl Iterator<Item = (Span, &'a tree::Test)> + use<'a> {
        self.own().filter_map(|declaration| match &declaration.kind {
            DeclarationKind::Test(test) => Some((declaration.span, test)),
            _ => None,
        })
    }

    pub(crate) fn own_claims(&self) -> impl Iterator<Item = (Span, &'a tree::Prove)> + use<'a> {
        self.own().filter_map(|declaration| match &declaration.kind {
            DeclarationKind::Prove(claim) => Some((declaration.span, claim)),
            _ => None,
        })
    }

    pub(crate) fn is_broken(&self, place: Span) -> bool {
        let before = self.broken.range(..=(place.file, place.start)).next_back();
        before.is_some_and(|(&(file, _), &end)| file == place.file && place.end <= end)
    }

    pub(crate) fn line(&self, place: Span) -> (String, usize) {
        let file = self.sources.file(place.file);
        (file.name.clone(), file.line_column(place.start as usize).line)
    }
}
