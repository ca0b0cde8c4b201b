//! Libraries: where robots come from.

use crate::check::fields::{self, Fields};
use crate::check::names::{Home, Names};
use crate::check::quantity;
use crate::diag::{Code, Diagnostic, suggest};
use crate::model::{Behavior, Function, LibrarySource, Origin};
use crate::syntax::tree::{RecordDeclaration, Value, ValueKind};

/// Checks a library.
pub(crate) fn library(
    source: &RecordDeclaration,
    home: Home,
    evolutions: &Names,
    faults: &mut Vec<Diagnostic>,
) -> Option<LibrarySource> {
    let what = format!("the library `{}`", source.name.text);
    let mut fields = Fields::new(what, source.name.span, &source.record);
    let from = fields.need("from", "from: shipped", |value| origin(value, home, evolutions));
    let behaviors = fields.read("behaviors", None, |value| behaviors(value).map(Some));
    faults.extend(fields.finish());
    Some(LibrarySource { name: source.name.text.clone(), span: source.name.span, from: from?, behaviors })
}

fn origin(value: &Value, home: Home, evolutions: &Names) -> Result<Origin, Diagnostic> {
    if let ValueKind::Text(folder) = &value.kind {
        return Ok(Origin::Folder(folder.clone()));
    }
    let name = fields::word(value, "`shipped`, the name of an evolution or a folder in quotes")?;
    if name.text == "shipped" {
        return Ok(Origin::Shipped);
    }
    evolutions.resolve(name, home).map(|_| Origin::Evolution(name.text.clone()))
}

fn behaviors(value: &Value) -> Result<Vec<Behavior>, Diagnostic> {
    fields::list(value).iter().map(behavior).collect()
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
