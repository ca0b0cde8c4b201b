//! From text to the tree, one declaration after another; never fails.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use pest::Parser;

use crate::syntax::convert::Converter;
use crate::syntax::expected;
use crate::syntax::grammar::{NbParser, Rule};
use crate::syntax::part::{PartKind, PartPlace};
use crate::syntax::recover;
use crate::syntax::split::{SourcePiece, Split, split_again};
use crate::syntax::tree::{BrokenSyntax, Declaration, InstanceSyntax, Tree, moved};
use crate::syntax::wording;
use nbc_base::budget::Limit;
use nbc_base::diag::Diagnostic;
use nbc_base::source::{FileId, Sources, Span};

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Parsed {
    pub tree: Tree,
    pub errors: Vec<Diagnostic>,
}

/// The last text of each file, by its name.
#[derive(Default)]
pub struct KnownTexts(BTreeMap<String, KnownText>);

#[derive(Default)]
struct KnownText {
    text: String,
    split: Split,
    /// Those without faults, by their own text.
    declarations: BTreeMap<String, Arc<Declaration>>,
}

pub fn parse(sources: &Sources, file: FileId) -> Parsed {
    parse_again(sources, file, &mut KnownTexts::default())
}

/// Parses only what is not known.
pub(crate) fn parse_again(sources: &Sources, file: FileId, known: &mut KnownTexts) -> Parsed {
    let text = &sources.file(file).text;
    if Limit::SourceBytes.permit(text.len() as u64).is_err() {
        let error = wording::large_file(text.len(), Limit::SourceBytes.most(), Span::new(file, 0, 0));
        return Parsed { errors: vec![error], ..Parsed::default() };
    }
    if let Some(at) = text.find('\0') {
        let error = wording::zero_byte(Span::new(file, at, at + 1));
        return Parsed { errors: vec![error], ..Parsed::default() };
    }
    let name = &sources.file(file).name;
    let KnownText { text: old, split, declarations: mut before } = known.0.remove(name).unwrap_or_default();
    let split = split_again(text, &old, split);
    let mut parsed = Parsed::default();
    parsed.tree.comments = split.comments.iter().map(|comment| Span::new(file, comment.start, comment.end)).collect();
    for comment in &split.foreign_comments {
        let span = Span::new(file, comment.start, comment.end);
        parsed.errors.push(wording::foreign_comment(&text[comment.clone()], &text[comment.end..], span));
    }
    let mut now = BTreeMap::new();
    for piece in &split.pieces {
        let source = &text[piece.range.clone()];
        if let Some((source, declaration)) = before.remove_entry(source) {
            let declaration = moved(declaration, file, piece.range.start as u32);
            parsed.tree.declarations.push(declaration.clone());
            now.insert(source, declaration);
            continue;
        }
        let faults = (parsed.errors.len(), parsed.tree.broken.len());
        parse_piece(text, file, &split, piece, &mut parsed);
        if faults == (parsed.errors.len(), parsed.tree.broken.len())
            && let Some(declaration) = parsed.tree.declarations.last()
        {
            now.insert(source.to_owned(), declaration.clone());
        }
    }
    known.0.insert(name.clone(), KnownText { text: text.clone(), split, declarations: now });
    parsed.errors.sort_by_key(|error| error.labels.first().map(|label| label.span));
    parsed
}

pub fn parse_instance(sources: &Sources, file: FileId) -> Result<InstanceSyntax, Diagnostic> {
    let text = sources.file(file).text.as_str();
    let mut converter = Converter::new(file, text, &[], 0);
    let parsed = NbParser::parse(Rule::one_instance, text).ok().and_then(|mut pairs| pairs.next());
    let instance = parsed.map(|pair| converter.instance(pair)).filter(|_| converter.errors.is_empty());
    let whole = Span::new(file, 0, text.len());
    instance.ok_or_else(|| wording::not_an_instance(text, whole))
}

fn parse_piece(text: &str, file: FileId, split: &Split, piece: &SourcePiece, parsed: &mut Parsed) {
    let (offset, end) = (piece.range.start, piece.range.end);
    let declaration = Span::new(file, offset, end);
    let place = |range: &Range<usize>| Span::new(file, offset + range.start, offset + range.end);
    if let Some(error) = over_limits(piece, Span { end: declaration.start + 1, ..declaration }) {
        parsed.errors.push(error);
        parsed.tree.broken.push(BrokenSyntax { span: declaration, declaration });
        return;
    }
    let mut source = text[piece.range.clone()].to_owned();
    let first = split.foreign_comments.partition_point(|comment| comment.start < offset);
    let comments = split.foreign_comments[first..].iter().take_while(|comment| comment.start < end);
    let semicolons = piece.semicolons.iter().map(|&at| at..at + 1);
    for hole in comments.cloned().chain(semicolons) {
        blank(&mut source, hole.start - offset..hole.end - offset);
    }
    let semicolon = |&at: &usize| wording::statement_end(";", Span::new(file, at, at + 1));
    if source.trim().is_empty() {
        parsed.errors.extend(piece.semicolons.iter().map(semicolon));
        parsed.tree.broken.push(BrokenSyntax { span: declaration, declaration });
        return;
    }
    let mut recovered = None;
    if let Err(error) = NbParser::parse(Rule::declaration, &source) {
        let found = recover::recover(file, &source, offset, expected::place(&error));
        let parts = source.clone();
        for range in &found.broken {
            blank(&mut source, range.clone());
        }
        recovered = Some((found, parts));
    }
    let mut converter = Converter::new(file, &source, &split.comments, offset);
    let tree = match NbParser::parse(Rule::declaration, &source) {
        Ok(pairs) => converter.declaration(pairs),
        Err(error) => {
            // Each part may be fine alone.
            if let Some((found, _)) = recovered.as_mut().filter(|(found, _)| found.errors.is_empty()) {
                let (kind, end) = (PartKind::Declaration, source.len());
                let place = PartPlace { file, source: &source, offset, kind, start: 0, end };
                found.errors.push(expected::diagnostic(&place, expected::place(&error), &error));
            }
            None
        }
    };
    if tree.is_none() {
        parsed.tree.broken.push(BrokenSyntax { span: declaration, declaration });
    }
    parsed.tree.broken.extend(converter.lost.drain(..).map(|span| BrokenSyntax { span, declaration }));
    // A declaration of another language has one message.
    if tree.is_some() || recovered.is_some() {
        converter.errors.extend(piece.semicolons.iter().map(semicolon));
    }
    if let Some((found, parts)) = recovered {
        if tree.is_none() {
            for (kind, range) in &found.kept {
                let offset = offset + range.start;
                let source = &parts[range.clone()];
                let mut part = Converter::new(file, source, &split.comments, offset);
                recover::slips(&mut part, *kind, source);
                converter.errors.append(&mut part.errors);
            }
        }
        let broken = found.broken.iter().map(|range| BrokenSyntax { span: place(range), declaration });
        parsed.tree.broken.extend(broken);
        converter.errors.extend(found.errors);
    }
    parsed.errors.append(&mut converter.errors);
    parsed.tree.declarations.extend(tree.map(Arc::new));
}

fn blank(text: &mut String, range: Range<usize>) {
    let space = |byte: u8| if matches!(byte, b'\n' | b'\r') { char::from(byte) } else { ' ' };
    let blanks: String = text[range.clone()].bytes().map(space).collect();
    text.replace_range(range, &blanks);
}

fn over_limits(piece: &SourcePiece, at: Span) -> Option<Diagnostic> {
    if Limit::Nesting.permit(piece.depth as u64).is_err() {
        return Some(wording::deep_declaration(piece.depth, Limit::Nesting.most(), at));
    }
    if Limit::NameBytes.permit(piece.name as u64).is_err() {
        return Some(wording::long_name(piece.name, Limit::NameBytes.most(), at));
    }
    let words = Limit::Words.permit(piece.words as u64);
    words.err().map(|_| wording::long_declaration(piece.words, Limit::Words.most(), at))
}
