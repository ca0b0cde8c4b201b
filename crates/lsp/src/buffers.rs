//! The texts that are open in the editor.

use std::collections::BTreeMap;

use gen_lsp_types::{TextDocumentContentChangeEvent, Uri};

use crate::position::{Encoding, Lines};
use crate::uri;
use nbc_base::source::LineStarts;

#[derive(Clone, Debug)]
pub(super) struct Buffer {
    pub(super) uri: Uri,
    pub(super) path: String,
    pub(super) version: i32,
    pub(super) text: String,
}

#[derive(Default)]
pub(super) struct Buffers {
    open: BTreeMap<String, Buffer>,
}

impl Buffers {
    pub(super) fn open(&mut self, uri: Uri, version: i32, text: String) -> &Buffer {
        let path = name(&uri);
        let buffer = Buffer { uri, path: path.clone(), version, text };
        self.open.entry(path).insert_entry(buffer).into_mut()
    }

    pub(super) fn change(
        &mut self,
        uri: &Uri,
        version: i32,
        changes: Vec<TextDocumentContentChangeEvent>,
        encoding: Encoding,
    ) -> Option<&Buffer> {
        let buffer = self.open.get_mut(&name(uri))?;
        for change in changes {
            match change {
                TextDocumentContentChangeEvent::TextDocumentContentChangePartial(change) => {
                    let starts = LineStarts::of(&buffer.text);
                    let bytes = Lines { text: &buffer.text, starts: &starts, encoding }.bytes(change.range);
                    buffer.text.replace_range(bytes, &change.text);
                }
                TextDocumentContentChangeEvent::TextDocumentContentChangeWholeDocument(change) => {
                    buffer.text = change.text;
                }
            }
        }
        buffer.version = version;
        Some(buffer)
    }

    pub(super) fn close(&mut self, uri: &Uri) -> Option<Buffer> {
        self.open.remove(&name(uri))
    }

    pub(super) fn get(&self, uri: &Uri) -> Option<&Buffer> {
        self.open.get(&name(uri))
    }

    pub(super) fn at(&self, path: &str) -> Option<&Buffer> {
        self.open.get(path)
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &Buffer> {
        self.open.values()
    }
}

fn name(uri: &Uri) -> String {
    uri::path(uri).unwrap_or_else(|| uri.to_string())
}
