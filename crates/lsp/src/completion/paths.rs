//! Paths of files and folders, between quotes.

use gen_lsp_types::{CompletionItem, CompletionItemKind, TextEdit};

use crate::completion::item::item;
use crate::spot::Spot;
use nbc_base::source::{EntryKind, Span};
use nbc_lang::check::{beside, is_usable};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PathKind {
    Source,
    Folder,
}

const MOST: usize = 1000;

/// `start` is the first byte of the path. Folders are offered too, because they may contain what is wanted.
pub(super) fn items(spot: &Spot<'_>, start: usize, kind: PathKind) -> Vec<CompletionItem> {
    let typed = &spot.text()[start..spot.offset];
    let (folder, name) = typed.split_at(typed.rfind('/').map_or(0, |slash| slash + 1));
    let own = &spot.files.checked.sources.file(spot.file).name;
    let place = Span::new(spot.file, spot.offset - name.len(), spot.offset);
    let offer = |(label, kind): (String, CompletionItemKind)| {
        let edit = TextEdit { range: spot.files.range(place), new_text: label.clone() };
        let detail = if kind == CompletionItemKind::Folder { "folder" } else { "file" };
        CompletionItem { text_edit: Some(edit.into()), ..item(&label, kind, detail) }
    };
    let is_own = |label: &str| beside(own, &format!("{folder}{label}")) == *own;
    let listed = match (beside(own, if folder.is_empty() { "." } else { folder }), own.starts_with('/')) {
        (path, _) if !path.is_empty() => entries(spot, &path, kind),
        (_, true) => entries(spot, "/", kind),
        (_, false) => entries(spot, ".", kind),
    };
    let shown = listed.into_iter().filter(|(label, _)| label.starts_with('.') <= name.starts_with('.'));
    shown.filter(|(label, _)| !is_own(label)).map(offer).collect()
}

fn entries(spot: &Spot<'_>, folder: &str, kind: PathKind) -> Vec<(String, CompletionItemKind)> {
    let world = spot.files.world;
    let names = world.list(folder).unwrap_or_default().into_iter().take(MOST);
    let named = |name: String| match world.kind(&format!("{folder}/{name}"))? {
        EntryKind::Folder => Some((name + "/", CompletionItemKind::Folder)),
        EntryKind::File => (kind == PathKind::Source && is_usable(&name)).then_some((name, CompletionItemKind::File)),
    };
    names.filter(|name| !name.contains(['"', char::REPLACEMENT_CHARACTER])).filter_map(named).collect()
}
