//! The declaration of a name, as Markdown.

use crate::files::Files;
use crate::interface::{comment, entry};
use nbc_base::source::Span;
use nbc_lang::check::{NameKind, NameUse};

pub(super) fn text(files: &Files<'_>, found: NameUse) -> String {
    let sources = &files.checked.sources;
    let source = &sources.file(found.declared.file).text;
    let around = declaration(files, found.declared);
    let (shown, commented) = match found.kind {
        NameKind::Net | NameKind::Number => {
            (format!("{} {}", found.kind.word(), entry(source, found.declared)), found.declared)
        }
        NameKind::Circuit => (head(sources.text(around)), around),
        _ => (sources.text(around).to_owned(), around),
    };
    let mut text = format!("```nb\n{shown}\n```\n");
    let comment = comment(source, commented);
    if !comment.is_empty() {
        text.push_str(&format!("\n{comment}\n"));
    }
    if files.prelude(found.declared.file).is_some() {
        text.push_str(&format!("\nA {} of every program.\n", found.kind.word()));
    }
    text
}

fn declaration(files: &Files<'_>, name: Span) -> Span {
    let declarations = files.checked.tree(name.file).into_iter().flat_map(|tree| &tree.declarations);
    declarations
        .map(|declaration| declaration.span)
        .find(|span| span.start <= name.start && name.end <= span.end)
        .unwrap_or(name)
}

fn head(declaration: &str) -> String {
    declaration.split('{').next().unwrap_or_default().split_whitespace().collect::<Vec<_>>().join(" ")
}
