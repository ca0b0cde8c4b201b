//! The canonical form of a text, as edits of its declarations, so that the rest of the text stays in its place.

use std::ops::Range;

use gen_lsp_types::TextEdit;

use crate::position::Lines;
use nbc_base::source::{Sources, Span};
use nbc_lang::syntax;
use nbc_session::Formatted;

/// Edits of the declarations in a part of a text, so that the rest stays in its place.
pub(super) fn edits(lines: &Lines<'_>, formatted: &Formatted, part: Range<usize>) -> Vec<TextEdit> {
    let (before, after) = (declarations(lines.text), declarations(&formatted.text));
    assert_eq!(before.len(), after.len(), "formatting keeps every declaration");
    let touches = |place: &Range<usize>| place.start <= part.end && part.start <= place.end;
    let pairs = before.into_iter().zip(after).filter(|(old, _)| touches(old));
    let edit = |(old, new): (Range<usize>, Range<usize>)| {
        let new_text = &formatted.text[new];
        let differs = lines.text[old.clone()] != *new_text;
        differs.then(|| TextEdit { range: lines.range(old), new_text: new_text.to_owned() })
    };
    pairs.filter_map(edit).collect()
}

fn declarations(text: &str) -> Vec<Range<usize>> {
    let mut sources = Sources::default();
    let file = sources.add("text", text);
    let tree = syntax::parse(&sources, file).tree;
    tree.declarations.iter().map(|declaration| declaration.span).map(Span::range).collect()
}
