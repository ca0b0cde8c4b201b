//! Errors that only follow from text that could not be parsed, or from files that could not be read, which have their
//! own messages.

use std::collections::BTreeSet;

use crate::check::load::Loaded;
use nbc_base::diag::{Code, Diagnostic};
use nbc_base::source::{Sources, Span};

/// Drops errors that follow from text that could not be parsed: in the same declaration, names that it mentions,
/// undriven nets, and missing fields and rows; everywhere, the names of lost declarations. If a used file could not be
/// read, unknown names without a near one may be declared there.
pub(crate) fn forget(diagnostics: &mut Vec<Diagnostic>, sources: &Sources, loaded: &Loaded) {
    let broken: Vec<_> = loaded.trees.iter().flat_map(|(_, tree)| &tree.broken).collect();
    let lost: BTreeSet<&str> = broken
        .iter()
        .filter(|part| part.span == part.declaration)
        .filter_map(|part| words(text(sources, part.span)).nth(1))
        .collect();
    let mut mentioned: Vec<(Span, BTreeSet<&str>)> = Vec::new();
    for part in broken {
        let own = words(text(sources, part.span));
        match mentioned.last_mut().filter(|(declaration, _)| *declaration == part.declaration) {
            Some((_, words)) => words.extend(own),
            None => mentioned.push((part.declaration, own.collect())),
        }
    }
    mentioned.sort_by_key(|(declaration, _)| *declaration);
    let follows = |diagnostic: &Diagnostic| {
        let Some(place) = diagnostic.labels.first().map(|label| label.span) else { return false };
        let word = words(text(sources, place)).next().unwrap_or_default();
        let may_be_elsewhere = diagnostic.fix.is_none() && loaded.incomplete.contains(&place.file);
        if diagnostic.code == Code::Unknown && (lost.contains(word) || may_be_elsewhere) {
            return true;
        }
        let next = mentioned
            .partition_point(|(declaration, _)| (declaration.file, declaration.start) <= (place.file, place.start));
        let Some((_, words)) = mentioned[..next]
            .last()
            .filter(|(declaration, _)| declaration.file == place.file && place.end <= declaration.end)
        else {
            return false;
        };
        match diagnostic.code {
            Code::MissingField | Code::Empty | Code::Undriven => true,
            Code::Unknown | Code::Unused | Code::UnknownWidth => words.contains(word),
            _ => false,
        }
    };
    diagnostics.retain(|diagnostic| !follows(diagnostic));
}

fn text(sources: &Sources, span: Span) -> &str {
    &sources.file(span.file).text[span.range()]
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|word| !word.is_empty())
}
