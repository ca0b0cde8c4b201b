//! What a name means, as Markdown.

use crate::check::{NameKind, NameUse};
use crate::cli::lsp::files::Files;
use crate::source::{Sources, Span};
use crate::syntax;

/// The declaration of a name, with the comment above it.
pub(super) fn text(files: &Files<'_>, found: NameUse) -> String {
    let sources = &files.checked.sources;
    let source = &sources.file(found.declared.file).text;
    let around = declaration(sources, found.declared);
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

/// The declaration around a name.
fn declaration(sources: &Sources, name: Span) -> Span {
    let tree = syntax::parse(sources, name.file).tree;
    let mut around = tree.declarations.iter().map(|declaration| declaration.span);
    around.find(|span| span.start <= name.start && name.end <= span.end).unwrap_or(name)
}

/// A circuit without its body, which begins at the first brace.
fn head(declaration: &str) -> String {
    declaration.split('{').next().unwrap_or_default().split_whitespace().collect::<Vec<_>>().join(" ")
}

/// A port, a net or a number, with its width or value.
fn entry(text: &str, place: Span) -> &str {
    let rest = &text[place.end as usize..];
    let end = match rest.as_bytes().first() {
        Some(b'[') => rest.find(']').map_or(0, |end| end + 1),
        _ => 0,
    };
    &text[place.start as usize..place.end as usize + end]
}

/// The comment in the lines just above a place.
fn comment(text: &str, place: Span) -> String {
    let line = text[..place.start as usize].rfind('\n').map_or(0, |end| end + 1);
    let mut lines: Vec<&str> = text[..line]
        .lines()
        .rev()
        .map_while(|line| line.trim_start().strip_prefix("//"))
        .take_while(|line| !line.starts_with('!'))
        .map(|line| line.trim_start_matches('/').trim())
        .collect();
    lines.reverse();
    lines.join("\n")
}
