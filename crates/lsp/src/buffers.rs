//! The sources that are open in the editor; the session has their texts.

use std::collections::BTreeMap;

use gen_lsp_types::{TextDocumentContentChangeEvent, Uri};

use crate::position::{Encoding, Lines};
use crate::uri;
use nbc_base::source::LineStarts;
use nbc_session::Session;

#[derive(Clone, Debug)]
pub(super) struct Buffer {
    pub(super) uri: Uri,
    pub(super) path: String,
    pub(super) version: i32,
}

#[derive(Default)]
pub(super) struct Buffers {
    open: BTreeMap<String, Buffer>,
}

impl Buffers {
    pub(super) fn open(&mut self, uri: Uri, version: i32) -> &Buffer {
        let path = name(&uri);
        self.open.entry(path.clone()).insert_entry(Buffer { uri, path, version }).into_mut()
    }

    pub(super) fn change(&mut self, uri: &Uri, version: i32) -> Option<&Buffer> {
        let buffer = self.open.get_mut(&name(uri))?;
        buffer.version = version;
        Some(buffer)
    }

    pub(super) fn close(&mut self, uri: &Uri) -> Option<Buffer> {
        self.open.remove(&name(uri))
    }

    pub(super) fn get(&self, uri: &Uri) -> Option<&Buffer> {
        self.open.get(&name(uri))
    }

    pub(super) fn has(&self, path: &str) -> bool {
        self.open.contains_key(path)
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &Buffer> {
        self.open.values()
    }
}

/// Of an open source.
pub(super) fn text(session: &Session, path: &str) -> String {
    session.text(path).expect("the session has the text of an open source")
}

pub(super) fn change(text: &mut String, change: TextDocumentContentChangeEvent, encoding: Encoding) {
    match change {
        TextDocumentContentChangeEvent::TextDocumentContentChangePartial(change) => {
            let starts = LineStarts::of(text);
            let bytes = Lines { text, starts: &starts, encoding }.bytes(change.range);
            text.replace_range(bytes, &change.text);
        }
        TextDocumentContentChangeEvent::TextDocumentContentChangeWholeDocument(change) => *text = change.text,
    }
}

fn name(uri: &Uri) -> String {
    uri::path(uri).unwrap_or_else(|| uri.to_string())
}
