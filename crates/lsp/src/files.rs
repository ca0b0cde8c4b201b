//! The files of a checked source as the protocol names them.

use gen_lsp_types::{Location, Range, Uri};

use crate::position::{Encoding, Lines};
use crate::shell::LanguageShell;
use crate::uri;
use nbc_base::source::{FileId, SourceWorld, Span};
use nbc_lang::check::PRELUDE;
use nbc_session::Checked;

#[derive(Clone, Copy)]
pub(super) struct Files<'a> {
    pub(super) checked: &'a Checked,
    pub(super) encoding: Encoding,
    pub(super) world: &'a dyn SourceWorld,
    pub(super) shell: &'a dyn LanguageShell,
}

impl Files<'_> {
    pub(super) fn own(&self) -> Uri {
        self.named(&self.checked.path)
    }

    pub(super) fn uri(&self, file: FileId) -> Uri {
        let name = &self.checked.sources.file(file).name;
        match self.prelude(file) {
            Some(text) => self.readable(name, text).unwrap_or_else(|| Uri(format!("{}:{name}", nbc_base::PROGRAM))),
            None => self.named(name),
        }
    }

    pub(super) fn named(&self, name: &str) -> Uri {
        let is_uri = name.contains("://") || name.starts_with("untitled:");
        if is_uri { Uri(name.to_owned()) } else { uri::uri(self.world, name) }
    }

    /// `None` if it cannot be written, or the client does not see such files.
    pub(super) fn readable(&self, name: &str, text: &str) -> Option<Uri> {
        Some(uri::uri(self.world, &self.shell.write_text(name, text)?))
    }

    pub(super) fn prelude(&self, file: FileId) -> Option<&'static str> {
        let source = self.checked.sources.file(file);
        let known = PRELUDE.into_iter().find(|(name, text)| *name == source.name && *text == source.text);
        known.filter(|_| self.checked.file != Some(file)).map(|(_, text)| text)
    }

    pub(super) fn range(&self, span: Span) -> Range {
        self.lines(span.file).range(span.range())
    }

    pub(super) fn location(&self, span: Span) -> Location {
        Location { uri: self.uri(span.file), range: self.range(span) }
    }

    pub(super) fn lines(&self, file: FileId) -> Lines<'_> {
        let source = self.checked.sources.file(file);
        Lines { text: &source.text, starts: source.lines(), encoding: self.encoding }
    }
}
