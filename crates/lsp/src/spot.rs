//! A place in a checked source.

use gen_lsp_types::Position;

use crate::files::Files;
use nbc_base::source::{FileId, Span};
use nbc_lang::check::NameUse;
use nbc_lang::syntax::tree::Declaration;
use nbc_lang::syntax::{self, Token};

#[derive(Clone, Copy)]
pub(super) struct Spot<'a> {
    pub(super) files: Files<'a>,
    pub(super) file: FileId,
    pub(super) offset: usize,
}

impl<'a> Spot<'a> {
    pub(super) fn of(files: Files<'a>, position: Position) -> Option<Self> {
        let file = files.checked.file?;
        Some(Self { files, file, offset: files.lines(file).offset(position) })
    }

    pub(super) fn text(&self) -> &'a str {
        &self.files.checked.sources.file(self.file).text
    }

    pub(super) fn name(&self) -> Option<NameUse> {
        self.files.checked.uses.at(self.file, self.offset)
    }

    pub(super) fn around(&self) -> Option<&'a Declaration> {
        let declarations = &self.files.checked.tree(self.file)?.declarations;
        declarations.iter().find(|declaration| self.is_in(declaration.span)).map(|found| &**found)
    }

    /// From the last declaration at the start of a line on, up to this place.
    pub(super) fn tokens(&self) -> Vec<Token> {
        let text = self.text();
        let declarations = self.files.checked.tree(self.file).map_or(&[][..], |tree| &tree.declarations[..]);
        let starts = declarations.iter().rev().map(|declaration| declaration.span.start as usize);
        let is_line = |start: &usize| *start <= self.offset && text[..*start].ends_with(['\n', '\r']);
        let start = starts.into_iter().find(is_line).unwrap_or(0);
        syntax::tokens_from(text, start).take_while(|token| token.range.start <= self.offset).collect()
    }

    pub(super) fn is_in(&self, span: Span) -> bool {
        span.file == self.file && (span.start as usize..=span.end as usize).contains(&self.offset)
    }
}
