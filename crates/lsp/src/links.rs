//! Files and folders that a source names, as links.

use gen_lsp_types::DocumentLink;

use crate::files::Files;
use nbc_base::source::{FileId, Span};
use nbc_lang::check::beside;
use nbc_lang::syntax::tree::{DeclarationKind, RecordKeyword, ValueKind};

pub(super) fn of(files: &Files<'_>, file: FileId) -> Vec<DocumentLink> {
    let declarations = files.checked.tree(file).into_iter().flat_map(|tree| &tree.declarations);
    let named = declarations.flat_map(|declaration| match &declaration.kind {
        DeclarationKind::Use(paths) => paths.iter().map(|path| (path.text.as_str(), path.span)).collect(),
        DeclarationKind::Record(record) if matches!(record.keyword, RecordKeyword::Images | RecordKeyword::Library) => {
            let from = record.record.field("from").map(|from| (&from.value.kind, from.value.span));
            match from {
                Some((ValueKind::Text(folder), span)) => vec![(folder.as_str(), span)],
                _ => Vec::new(),
            }
        }
        _ => Vec::new(),
    });
    named.filter_map(|(path, place)| link(files, path, place)).collect()
}

fn link(files: &Files<'_>, path: &str, place: Span) -> Option<DocumentLink> {
    let path = beside(&files.checked.sources.file(place.file).name, path);
    let inner = Span { start: place.start + 1, end: place.end - 1, ..place };
    files.world.kind(&path).map(|_| DocumentLink {
        range: files.range(inner),
        target: Some(files.named(&path)),
        tooltip: None,
        data: None,
    })
}
