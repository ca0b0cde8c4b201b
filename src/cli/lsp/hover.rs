//! What a name means, as Markdown.

use crate::check::{NameKind, NameUse};
use crate::cli::lsp::files::Files;
use crate::source::Span;

/// The declaration of a name, with the comment above it.
pub(super) fn text(files: &Files<'_>, found: NameUse) -> String {
    let source = files.checked.sources.file(found.declared.file);
    let declaration = match found.kind {
        NameKind::Circuit => head(&source.text, found.declared),
        NameKind::Net | NameKind::Number => format!("{} {}", found.kind.word(), entry(&source.text, found.declared)),
        _ => whole(&source.text, found.declared),
    };
    let mut text = format!("```nb\n{declaration}\n```\n");
    let comment = comment(&source.text, found.declared);
    if !comment.is_empty() {
        text.push_str(&format!("\n{comment}\n"));
    }
    if files.prelude(found.declared.file).is_some() {
        text.push_str(&format!("\nA {} of every program.\n", found.kind.word()));
    }
    text
}

/// The start of the line of a place.
fn line_start(text: &str, place: Span) -> usize {
    text[..place.start as usize].rfind('\n').map_or(0, |end| end + 1)
}

/// A circuit without its body.
fn head(text: &str, place: Span) -> String {
    let start = line_start(text, place);
    let end = text[start..].find('{').map_or(text.len(), |end| start + end);
    text[start..end].split_whitespace().collect::<Vec<_>>().join(" ")
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

/// The lines of a declaration whose braces are balanced.
fn whole(text: &str, place: Span) -> String {
    let start = line_start(text, place);
    let mut depth = 0;
    let mut end = text.len();
    for (at, character) in text[start..].char_indices() {
        match character {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        let closes = character == '}' && depth == 0;
        if closes || character == '\n' && depth == 0 {
            end = start + at + usize::from(closes);
            break;
        }
    }
    text[start..end].trim_end().to_owned()
}

/// The comment in the lines just above a place.
fn comment(text: &str, place: Span) -> String {
    let mut lines: Vec<&str> = text[..line_start(text, place)]
        .lines()
        .rev()
        .map_while(|line| line.trim_start().strip_prefix("//"))
        .take_while(|line| !line.starts_with('!'))
        .map(|line| line.trim_start_matches('/').trim())
        .collect();
    lines.reverse();
    lines.join("\n")
}
