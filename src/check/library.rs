//! Libraries: where robots come from.

use crate::check::fields::{self, Fields};
use crate::check::load::beside;
use crate::check::names::{Home, Names};
use crate::check::quantity;
use crate::diag::{Code, Diagnostic, suggest};
use crate::model::{Behavior, Function, LibrarySource, Origin};
use crate::source::{FileError, SourceWorld, Sources};
use crate::syntax::tree::{DeclarationKind, Record, RecordDeclaration, RecordKeyword, Tree, Value, ValueKind};

/// Checks a library.
pub(crate) fn library(
    source: &RecordDeclaration,
    home: Home,
    evolutions: &Names,
    sources: &Sources,
    faults: &mut Vec<Diagnostic>,
) -> Option<LibrarySource> {
    let what = format!("the library `{}`", source.name.text);
    let mut fields = Fields::new(what, source.name.span, &source.record);
    let from = fields.need("from", "from: shipped", |value| origin(value, home, evolutions, sources));
    let behaviors = fields.read_list("behaviors", behavior);
    faults.extend(fields.finish());
    Some(LibrarySource { name: source.name.text.clone(), span: source.name.span, from: from?, behaviors })
}

/// Folders of libraries that contain no robots.
pub(crate) fn folders(world: &dyn SourceWorld, sources: &Sources, trees: &[(Home, Tree)]) -> Vec<Diagnostic> {
    let declarations = trees.iter().flat_map(|(_, tree)| &tree.declarations);
    let records = declarations.filter_map(|declaration| match &declaration.kind {
        DeclarationKind::Record(record) if record.keyword == RecordKeyword::Library => Some(&record.record),
        _ => None,
    });
    let from =
        |record: &Record| record.fields.iter().find(|field| field.name.text == "from").map(|field| field.value.clone());
    records.filter_map(from).filter_map(|value| folder_fault(world, sources, &value)).collect()
}

fn folder_fault(world: &dyn SourceWorld, sources: &Sources, value: &Value) -> Option<Diagnostic> {
    let ValueKind::Text(path) = &value.kind else { return None };
    let folder = beside(&sources.file(value.span.file).name, path);
    let why = match world.list(&folder) {
        Ok(names) if names.iter().any(|name| name.ends_with(".yaml")) => return None,
        Ok(_) => "it holds no robot files (.yaml)".to_owned(),
        Err(FileError::NotFound) => "there is no such folder".to_owned(),
        Err(FileError::Io(words)) => words,
        Err(_) => "it is not a folder".to_owned(),
    };
    let message = format!("cannot read the library `{folder}`: {why}");
    let fault = Diagnostic::new(Code::Unreadable, message, value.span, "expected a folder of robot files");
    Some(fault.with_help("the path starts from the file that names it; `nbc library add` writes robot files"))
}

fn origin(value: &Value, home: Home, evolutions: &Names, sources: &Sources) -> Result<Origin, Diagnostic> {
    if let ValueKind::Text(folder) = &value.kind {
        return Ok(Origin::Folder(beside(&sources.file(value.span.file).name, folder)));
    }
    let name = fields::word(value, "`shipped`, the name of an evolution or a folder in quotes")?;
    if name.text == "shipped" {
        return Ok(Origin::Shipped);
    }
    evolutions.resolve(name, home).map(|_| Origin::Evolution(name.text.clone()))
}

/// A function by its name, or a behavior by its four letters.
fn behavior(value: &Value) -> Result<Behavior, Diagnostic> {
    let name = fields::word(value, "a function such as `nand`, or a behavior such as `RRRL`")
        .map_err(|_| quantity::wrong_kind("a function such as `nand`, or a behavior such as `RRRL`", value.span))?;
    if let Some(function) = Function::parse(&name.text) {
        return Ok(function.into());
    }
    name.text.parse().map_err(|_| {
        let known: Vec<_> = Function::all().map(Function::name).collect();
        let fault =
            Diagnostic::new(Code::Unknown, format!("no behavior is called `{}`", name.text), name.span, "not known");
        match suggest::nearest(&name.text, known) {
            Some(near) => fault.with_help(format!("did you mean `{near}`?")),
            None => fault.with_help("name a function such as `nand`, or write four letters such as `RRRL`"),
        }
    })
}
