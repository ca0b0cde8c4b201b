//! From text to the tree, one declaration after another; never fails.

use std::ops::Range;

use pest::Parser;

use crate::diag::Diagnostic;
use crate::source::{FileId, Sources, Span};
use crate::syntax::convert::Converter;
use crate::syntax::expected;
use crate::syntax::grammar::{NbParser, Rule};
use crate::syntax::split::{SourcePiece, split};
use crate::syntax::tree::{Declaration, InstanceSyntax, Tree};
use crate::syntax::wording::SyntaxError;

/// The largest source text, in bytes.
pub const MAX_SOURCE_BYTES: u64 = 8 << 20;

/// The deepest nesting of brackets and `if`. It is small enough for the parser, checker and formatter to fit in the
/// stack of any thread.
pub const MAX_NESTING: usize = 64;

/// The most tokens of a declaration, which bounds the time of parsing.
pub const MAX_WORDS: usize = 2_000_000;

/// The tree of a text, and its errors.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Parsed {
    /// Everything that could be parsed.
    pub tree: Tree,
    pub errors: Vec<Diagnostic>,
}

/// Parses a file of `sources`.
pub fn parse(sources: &Sources, file: FileId) -> Parsed {
    let text = &sources.file(file).text;
    if text.len() as u64 > MAX_SOURCE_BYTES {
        let error = SyntaxError::TooLarge { bytes: text.len(), most: MAX_SOURCE_BYTES };
        return Parsed { errors: vec![error.at(Span::new(file, 0, 0))], ..Parsed::default() };
    }
    if let Some(at) = text.find('\0') {
        let error = SyntaxError::ZeroByte.at(Span::new(file, at, at + 1));
        return Parsed { errors: vec![error], ..Parsed::default() };
    }
    let split = split(text);
    let mut parsed = Parsed::default();
    parsed.tree.comments = split.comments.iter().map(|comment| Span::new(file, comment.start, comment.end)).collect();
    for piece in &split.pieces {
        let (declaration, errors) = parse_piece(text, file, &split.comments, piece);
        if declaration.is_none() {
            parsed.tree.broken.extend(name_of(text, file, piece));
        }
        parsed.tree.declarations.extend(declaration);
        parsed.errors.extend(errors);
    }
    parsed
}

/// Parses a text that names a circuit with its parameters, such as `adder[8]` on a command line.
///
/// # Errors
/// When it is anything else.
pub fn parse_instance(sources: &Sources, file: FileId) -> Result<InstanceSyntax, Diagnostic> {
    let text = sources.file(file).text.as_str();
    let mut converter = Converter { file, text, comments: &[], offset: 0, errors: Vec::new() };
    let parsed = NbParser::parse(Rule::one_instance, text).ok().and_then(|mut pairs| pairs.next());
    let instance = parsed.map(|pair| converter.instance(pair)).filter(|_| converter.errors.is_empty());
    let whole = Span::new(file, 0, text.len());
    instance.ok_or_else(|| SyntaxError::NotAnInstance { text: text.to_owned() }.at(whole))
}

/// The word after the keyword of a declaration.
fn name_of(text: &str, file: FileId, piece: &SourcePiece) -> Option<Span> {
    let source = &text[piece.range.clone()];
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let keyword = source.find(|c| !is_word(c))?;
    let start = keyword + source[keyword..].find(|c: char| !c.is_whitespace())?;
    let end = source[start..].find(|c| !is_word(c)).map_or(source.len(), |length| start + length);
    (end > start).then(|| Span::new(file, piece.range.start + start, piece.range.start + end))
}

fn parse_piece(
    text: &str,
    file: FileId,
    comments: &[Range<usize>],
    piece: &SourcePiece,
) -> (Option<Declaration>, Vec<Diagnostic>) {
    if let Some(error) = over_limits(piece) {
        return (None, vec![error.at(Span::new(file, piece.range.start, piece.range.start + 1))]);
    }
    let source = &text[piece.range.clone()];
    let mut converter = Converter { file, text, comments, offset: piece.range.start, errors: Vec::new() };
    let declaration = match NbParser::parse(Rule::declaration, source) {
        Ok(pairs) => converter.declaration(pairs),
        Err(error) => {
            converter.errors.push(expected::diagnostic(text, file, piece, &error));
            None
        }
    };
    (declaration, converter.errors)
}

/// The error of a declaration that is nested too deeply or too long to be parsed.
fn over_limits(piece: &SourcePiece) -> Option<SyntaxError> {
    if piece.depth > MAX_NESTING {
        return Some(SyntaxError::TooDeep { depth: piece.depth, most: MAX_NESTING });
    }
    (piece.words > MAX_WORDS).then_some(SyntaxError::TooLong { words: piece.words, most: MAX_WORDS })
}
