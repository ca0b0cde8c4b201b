//! The files of a checked source as the protocol names them.

use gen_lsp_types::{Location, Range, Uri};

use crate::position::{Encoding, Lines};
use crate::uri;
use nbc_base::source::{FileId, Span};
use nbc_lang::check::PRELUDE;
use nbc_session::Checked;
use nbc_session::store;

/// A checked source and how its client counts characters.
#[derive(Clone, Copy)]
pub(super) struct Files<'a> {
    pub(super) checked: &'a Checked,
    pub(super) encoding: Encoding,
}

impl Files<'_> {
    /// The URI of the source itself.
    pub(super) fn own(&self) -> Uri {
        named(&self.checked.path)
    }

    /// The URI of one of its files.
    pub(super) fn uri(&self, file: FileId) -> Uri {
        match self.prelude(file) {
            Some(text) => uri::uri(&readable(&self.checked.sources.file(file).name, text)),
            None => named(&self.checked.sources.file(file).name),
        }
    }

    /// The text of a file, if it is one of the prelude.
    pub(super) fn prelude(&self, file: FileId) -> Option<&'static str> {
        let source = self.checked.sources.file(file);
        let known = PRELUDE.into_iter().find(|(name, text)| *name == source.name && *text == source.text);
        known.filter(|_| self.checked.file != Some(file)).map(|(_, text)| text)
    }

    /// A place in its file.
    pub(super) fn range(&self, span: Span) -> Range {
        self.lines(span.file).range(span.range())
    }

    /// A place with its file.
    pub(super) fn location(&self, span: Span) -> Location {
        Location { uri: self.uri(span.file), range: self.range(span) }
    }

    /// The lines of a file.
    pub(super) fn lines(&self, file: FileId) -> Lines<'_> {
        let source = self.checked.sources.file(file);
        Lines { text: &source.text, starts: source.lines(), encoding: self.encoding }
    }
}

/// The URI of a path, or of a text without a file, whose name is its URI.
fn named(name: &str) -> Uri {
    if name.contains("://") || name.starts_with("untitled:") { Uri(name.to_owned()) } else { uri::uri(name) }
}

/// Writes a text of the program to a file that editors can open, and returns its path. If the file cannot be written,
/// there is none at that path.
pub(super) fn readable(name: &str, text: &str) -> String {
    let Ok(folder) = store::temporary_folder() else { return name.to_owned() };
    let path = folder.join(name);
    if std::fs::read_to_string(&path).ok().as_deref() != Some(text) {
        let _ = store::write(&path, text.as_bytes());
    }
    path.to_string_lossy().into_owned()
}
