//! The uses of a name, and edits that rename it.

use gen_lsp_types::{
    BaseSymbolInformation, DocumentHighlight, DocumentHighlightKind, Location, SymbolKind, TextEdit, Uri,
    WorkspaceEdit, WorkspaceSymbol,
};

use crate::files::Files;
use crate::wording::{self, RequestError};
use nbc_base::source::Span;
use nbc_circuit::formats::is_word;
use nbc_lang::check::{NameKind, NameUse};

pub(super) fn highlights(files: &Files<'_>, found: NameUse) -> Vec<DocumentHighlight> {
    let same = files.checked.uses.of(found.declared).filter(|other| other.place.file == found.place.file);
    let highlight = |other: NameUse| DocumentHighlight {
        range: files.range(other.place),
        kind: Some(if other.place == other.declared {
            DocumentHighlightKind::Write
        } else {
            DocumentHighlightKind::Read
        }),
    };
    same.map(highlight).collect()
}

pub(super) fn uses(files: &Files<'_>, home: &Uri, declared: Span, with_declaration: bool) -> Vec<Location> {
    let own = files.checked.sources.iter().filter(|source| files.uri(source.id) == *home);
    let declared = own.map(|source| Span { file: source.id, ..declared });
    let places = declared.flat_map(|declared| {
        let used = files.checked.uses.of(declared);
        used.filter(move |found| with_declaration || found.place != declared).map(|found| found.place)
    });
    places.map(|place| files.location(place)).collect()
}

/// In the source itself; upper and lower case are the same.
pub(super) fn declarations(files: &Files<'_>, query: &str) -> Vec<WorkspaceSymbol> {
    let query = query.to_lowercase();
    let Some(file) = files.checked.file else { return Vec::new() };
    let symbol = |found: NameUse| {
        let kind = match found.kind {
            NameKind::Net | NameKind::Number => return None,
            NameKind::Circuit => SymbolKind::Function,
            NameKind::Stimulus => SymbolKind::Event,
            NameKind::Material => SymbolKind::Constant,
            NameKind::Images | NameKind::Schedule => SymbolKind::Array,
            NameKind::Evolution => SymbolKind::Class,
            NameKind::Library => SymbolKind::Package,
            NameKind::Swarm => SymbolKind::Object,
            NameKind::World => SymbolKind::Namespace,
            NameKind::Enumeration => SymbolKind::Enum,
            NameKind::Member => SymbolKind::EnumMember,
            NameKind::File => SymbolKind::File,
        };
        let name = files.checked.sources.text(found.place).to_owned();
        let is_wanted = found.place == found.declared && name.to_lowercase().contains(&query);
        is_wanted.then(|| WorkspaceSymbol {
            location: files.location(found.place).into(),
            data: None,
            base_symbol_information: BaseSymbolInformation { name, kind, tags: None, container_name: None },
        })
    };
    files.checked.uses.of_file(file).filter_map(symbol).collect()
}

pub(super) fn refusal(files: &Files<'_>, found: NameUse, new: &str) -> Option<RequestError> {
    if files.prelude(found.declared.file).is_some() {
        return Some(wording::name_of_prelude());
    }
    (!is_word(new)).then(|| wording::not_a_name(new))
}

pub(super) fn workspace_edit(edits: impl Iterator<Item = (Uri, TextEdit)>) -> WorkspaceEdit {
    let mut edit = WorkspaceEdit::default();
    let changes = edit.changes.get_or_insert_default();
    edits.for_each(|(uri, edit)| changes.entry(uri).or_default().push(edit));
    edit
}
