//! Libraries: where robots come from.

use crate::check::fields::{self, Fields};
use crate::check::load::beside;
use crate::check::names::{Home, NameTable};
use crate::check::wording;
use crate::syntax::tree::{
    DeclarationKind, RecordDeclaration, RecordKeyword, RecordSyntax, Tree, ValueKind, ValueSyntax,
};
use nbc_base::diag::{Diagnostic, Suggestion};
use nbc_base::model::{Behavior, Function, LibrarySource, Origin};
use nbc_base::source::{SourceWorld, Sources, Span};

pub(crate) fn library(
    source: &RecordDeclaration,
    home: Home,
    evolutions: &NameTable,
    sources: &Sources,
    faults: &mut Vec<Diagnostic>,
) -> Option<LibrarySource> {
    let mut fields = Fields::new("library", source);
    let from = fields.need("from", "from: shipped", |value| origin(value, home, evolutions, sources));
    let behaviors = fields.read_list("behaviors", behavior);
    let without = fields.read_list("without", robot).unwrap_or_default();
    faults.extend(fields.finish());
    Some(LibrarySource { name: source.name.text.clone(), span: source.name.span, from: from?, behaviors, without })
}

pub(crate) fn folders(world: &dyn SourceWorld, sources: &Sources, trees: &[(Home, Tree)]) -> Vec<Diagnostic> {
    let declarations = trees.iter().flat_map(|(_, tree)| &tree.declarations);
    let records = declarations.filter_map(|declaration| match &declaration.kind {
        DeclarationKind::Record(record) if record.keyword == RecordKeyword::Library => Some(&record.record),
        _ => None,
    });
    let from = |record: &RecordSyntax| record.field("from").map(|field| field.value.clone());
    records.filter_map(from).filter_map(|value| folder_fault(world, sources, &value)).collect()
}

fn folder_fault(world: &dyn SourceWorld, sources: &Sources, value: &ValueSyntax) -> Option<Diagnostic> {
    let ValueKind::Text(path) = &value.kind else { return None };
    let folder = beside(&sources.file(value.span.file).name, path);
    match world.list(&folder) {
        Ok(names) if names.iter().any(|name| name.ends_with(".yaml")) => None,
        Ok(_) => Some(wording::empty_library(&folder, value.span)),
        Err(error) => Some(wording::unreadable_library(&folder, &error, value.span)),
    }
}

fn origin(value: &ValueSyntax, home: Home, evolutions: &NameTable, sources: &Sources) -> Result<Origin, Diagnostic> {
    if let ValueKind::Text(folder) = &value.kind {
        return Ok(Origin::Folder(beside(&sources.file(value.span.file).name, folder)));
    }
    let name = fields::word(value, wording::ORIGIN)?;
    match name.text.as_str() {
        "shipped" => return Ok(Origin::Shipped),
        "three" => return Ok(Origin::Three),
        _ => {}
    }
    evolutions.resolve_beside(name, home, &["shipped", "three"]).map(|_| Origin::Evolution(name.text.clone()))
}

fn robot(value: &ValueSyntax) -> Result<(String, Span), Diagnostic> {
    match &value.kind {
        ValueKind::Text(name) => Ok((name.clone(), value.span)),
        _ => fields::name(value, "robot").map(|name| (name.text.clone(), name.span)),
    }
}

/// A function by its name, or a behavior by its four or eight letters.
pub(crate) fn behavior(value: &ValueSyntax) -> Result<Behavior, Diagnostic> {
    let name = fields::word(value, wording::BEHAVIOR)?;
    if let Some(function) = Function::parse(&name.text) {
        return Ok(function.into());
    }
    name.text.parse().map_err(|_| {
        let meant = Suggestion::near(&name.text, Function::named().map(Function::name));
        wording::unknown_behavior(name, &meant)
    })
}
